"""The gRPC service around a worker: `linchpin.v1.Worker` and health."""

from __future__ import annotations

import os
import pathlib
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from types import TracebackType
from typing import Any

import grpc

from . import cancel
from ._contract import wire_pb2
from ._contract import worker_pb2 as pb
from .address import Address, ListenError
from .certificates import credentials, owner_of
from .failures import CallFailed, Denied, NoInstance
from .hold import Hold, connection
from .host import Host
from .status import abort
from .token import Demanding, read_token

GRACE = 0.5
"""s that calls under way have to finish after a shutdown; then they are cancelled."""

TIDY = 0.5
"""s between two looks for instances whose lease is over."""

OTHER_CALLS = 8
"""Calls beside the exchange streams of all instances that can be answered at a time."""

WORKER = pb.DESCRIPTOR.services_by_name["Worker"]

UNARY: dict[str, Callable[..., Any]] = {
    "Describe": Host.describe,
    "Initialize": Host.initialize,
    "Snapshot": Host.snapshot,
    "Restore": Host.restore,
    "ExportState": Host.export_state,
    "ImportState": Host.import_state,
    "Step": Host.step,
    "PerturbedStep": Host.perturbed_step,
    "Evaluate": Host.evaluate,
    "Terminate": Host.terminate,
    "ListInstances": Host.list_instances,
}


class Server:
    """A worker that listens. It serves from the start of a `with` statement to its end."""

    def __init__(
        self,
        host: Host,
        address: Address,
        plain_text: bool = False,
        certificates: str | None = None,
        token: str | None = None,
    ) -> None:
        """Begins to listen; `ListenError` if that cannot be.

        With a folder of certificates, masters have to show one; with the file of a token, that.
        """
        address.check(plain_text, certificates is not None)
        interceptors = [Demanding(read_token(token))] if token is not None else []
        secure = credentials(certificates) if certificates is not None else None
        self._host = host
        # A stream keeps its thread until it ends; threads are made as they are needed.
        self._threads = ThreadPoolExecutor(host.limits.instances + OTHER_CALLS, thread_name_prefix="linchpin-worker")
        options = [
            # A second worker must not take half of the connections to a port.
            ("grpc.so_reuseport", 0),
            ("grpc.max_receive_message_length", host.limits.message),
            ("grpc.max_send_message_length", host.limits.message),
        ]
        self._server = grpc.server(self._threads, options=options, interceptors=interceptors)
        self._server.add_generic_rpc_handlers((self._worker(), health()))
        # The socket is for the own user alone, whatever the umask was.
        before = os.umask(0o177)
        try:
            target = address.target()
            port = self._server.add_secure_port(target, secure) if secure else self._server.add_insecure_port(target)
        except RuntimeError as error:
            raise ListenError(f"cannot listen on {address}: {error}") from error
        finally:
            os.umask(before)
        self.address = Address(address.host, port, "") if address.host else address
        self.url = str(self.address).replace("http:", "https:") if secure else str(self.address)
        """Its address as a master writes it in a scene."""
        self._stopped = threading.Event()

    def __enter__(self) -> Server:
        """Answers calls from now on."""
        self._server.start()
        threading.Thread(target=self._tidy, name="linchpin-worker-tidy", daemon=True).start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None) -> None:
        """Takes no new calls; those under way have `GRACE` to finish."""
        if self.address.path:
            # While it still listens the file is its own; later a successor may have put its own there.
            pathlib.Path(self.address.path).unlink(missing_ok=True)
        self._stopped.set()
        self._server.stop(GRACE).wait()
        self._threads.shutdown(wait=False)

    def _tidy(self) -> None:
        while not self._stopped.wait(TIDY):
            self._host.tidy()

    def _worker(self) -> grpc.GenericRpcHandler:
        handlers = {}
        for method in WORKER.methods:
            request = getattr(pb, method.input_type.name)
            make, answer = (
                (grpc.stream_stream_rpc_method_handler, self._exchange)
                if method.client_streaming
                else (grpc.unary_unary_rpc_method_handler, partial(self._answer, UNARY[method.name]))
            )
            handlers[method.name] = make(answer, request.FromString, serialized)
        return grpc.method_handlers_generic_handler(WORKER.full_name, handlers)

    def _answer(self, call: Callable[..., Any], request: Any, context: grpc.ServicerContext) -> Any:
        """Answers a unary call; its connection holds the instance that it names, if that is the caller's."""
        owner = owner_of(context)
        # gRPC forgets it when the call has ended; one that had ended before it came here holds nothing.
        peer = context.peer()
        names_instance = "instance" in request.DESCRIPTOR.fields_by_name
        try:
            if names_instance:
                self._host.check_owner(request.instance, owner)
            with cancel.within(lambda: not context.is_active()):
                if call in (Host.initialize, Host.list_instances):
                    return call(self._host, request, owner)
                return call(self._host, request)
        except Denied as failed:
            names_instance = False
            return abort(context, failed)
        except CallFailed as failed:
            return abort(context, failed)
        finally:
            if names_instance and peer:
                self._host.hold(request.instance, connection(peer, self.address.path))

    def _exchange(self, requests: Iterator[pb.ExchangeRequest], context: grpc.ServicerContext) -> Iterator[pb.ExchangeReply]:
        """The turns of a stream, which holds its instance from the first turn on, and ends where it is not there."""
        stream, held, owner = Hold(is_stream=True), None, owner_of(context)
        if not context.add_callback(stream.end):
            return
        for request in requests:
            try:
                self._host.check_owner(request.instance, owner)
                if held != request.instance:
                    self._host.hold(request.instance, stream)
                    held = request.instance
                with cancel.within(lambda: not context.is_active()):
                    reply = self._host.exchange(request)
                yield reply
            except (NoInstance, Denied) as failed:
                abort(context, failed)
            except CallFailed as failed:
                yield pb.ExchangeReply(sequence=request.sequence, instance=held, failure=failed.failure)


def health() -> grpc.GenericRpcHandler:
    """The standard service `grpc.health.v1.Health`: a worker that answers serves."""
    known = ("", WORKER.full_name)
    response = wire_pb2.HealthCheckResponse

    def check(request: wire_pb2.HealthCheckRequest, context: grpc.ServicerContext) -> wire_pb2.HealthCheckResponse:
        if request.service not in known:
            context.abort(grpc.StatusCode.NOT_FOUND, f'no service "{request.service}"; there is {WORKER.full_name}')
        return response(status=response.SERVING)

    def watch(request: wire_pb2.HealthCheckRequest, context: grpc.ServicerContext) -> Iterator[wire_pb2.HealthCheckResponse]:
        ended = threading.Event()
        if context.add_callback(ended.set):
            yield response(status=response.SERVING if request.service in known else response.SERVICE_UNKNOWN)
            ended.wait()

    read = wire_pb2.HealthCheckRequest.FromString
    handlers = {
        "Check": grpc.unary_unary_rpc_method_handler(check, read, serialized),
        "Watch": grpc.unary_stream_rpc_method_handler(watch, read, serialized),
    }
    return grpc.method_handlers_generic_handler("grpc.health.v1.Health", handlers)


def serialized(message: Any) -> bytes:
    """A reply as bytes."""
    return message.SerializeToString()  # type: ignore[no-any-return]
