"""A secret that masters on the same machine show, which other users of the machine do not have."""

from __future__ import annotations

import hmac
import pathlib
import re
from collections.abc import Callable
from typing import Any

import grpc

from .address import ListenError

HEADER, SCHEME = "authorization", "Bearer "
"""Where it stands in a call."""

SHORTEST, LONGEST = 32, 1024
"""Its length in characters: 128 bits in hexadecimal digits at least."""

OTHERS = 0o077
"""Permissions of others than the owner of a file."""

OPEN_TO_ALL = "/grpc.health.v1.Health/"
"""Calls that need none."""

ANOTHER = "the worker has another token; give both ends the same file"
MISSING = "the worker demands a token; give its file with --token (in a scene: security.token)"


def read_token(path: str) -> str:
    """The token of a file that only its user can read; `ListenError` otherwise."""
    file = pathlib.Path(path)
    try:
        mode, text = file.stat().st_mode, file.read_bytes()
    except OSError as error:
        reason = f"{error.strerror}; the path counts from the current folder"
        raise ListenError(f"cannot read the token {path}: {reason}") from error
    if mode & OTHERS:
        rule = "take that away with chmod 600, and write a new one into it"
        raise ListenError(f"the token {path} can be read by other users; {rule}")
    token = text.rstrip()
    if not re.fullmatch(rb"[!-~]{%d,%d}" % (SHORTEST, LONGEST), token):
        line = f"one line of {SHORTEST} to {LONGEST} letters, digits and signs, as of openssl rand -hex 32"
        raise ListenError(f"{path} holds no token: it must be {line}")
    return token.decode("ascii")


class Demanding(grpc.ServerInterceptor):  # type: ignore[misc]
    """Refuses calls that do not show the token, but for those of health."""

    def __init__(self, token: str) -> None:
        self._expected = f"{SCHEME}{token}".encode("ascii")

    def intercept_service(
        self, continuation: Callable[[grpc.HandlerCallDetails], Any], details: grpc.HandlerCallDetails
    ) -> grpc.RpcMethodHandler:
        """The handler of a call, or one in its place that refuses it."""
        handler = continuation(details)
        shown = [value for key, value in details.invocation_metadata if key == HEADER]
        if handler is None or details.method.startswith(OPEN_TO_ALL) or self._is_right(shown):
            return handler
        return refusing(ANOTHER if shown else MISSING, handler)

    def _is_right(self, shown: list[str | bytes]) -> bool:
        """Compares in a time that does not tell how much is right."""
        values = [value if isinstance(value, bytes) else value.encode("utf-8", "surrogateescape") for value in shown]
        return len(values) > 0 and hmac.compare_digest(values[0], self._expected)


def refusing(reason: str, handler: grpc.RpcMethodHandler) -> grpc.RpcMethodHandler:
    """Refuses calls of the kind of `handler`."""

    def refuse(_: Any, context: grpc.ServicerContext) -> Any:
        context.abort(grpc.StatusCode.UNAUTHENTICATED, reason)

    if handler.request_streaming:
        return grpc.stream_stream_rpc_method_handler(refuse)
    return grpc.unary_unary_rpc_method_handler(refuse)
