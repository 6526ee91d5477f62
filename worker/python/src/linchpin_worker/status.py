"""Failures as gRPC statuses: the code carries the severity, a `google.rpc.ErrorInfo` what is known beyond the message."""

import grpc

from ._contract import wire_pb2
from ._contract import worker_pb2 as pb
from .failures import CallFailed, Denied, NoInstance

DOMAIN = "linchpin"

CODES = {
    pb.SEVERITY_MISUSE: grpc.StatusCode.INVALID_ARGUMENT,
    pb.SEVERITY_RECOVERABLE: grpc.StatusCode.ABORTED,
    pb.SEVERITY_FATAL: grpc.StatusCode.INTERNAL,
}

OTHER_CODES = {NoInstance: grpc.StatusCode.NOT_FOUND, Denied: grpc.StatusCode.PERMISSION_DENIED}

# Longest message and longest other text of a status, in bytes. A status travels in HTTP headers, and peers drop those
# beyond some 16 kB; the message is in there twice, once with up to three bytes for one.
LONGEST_MESSAGE = 2048
LONGEST_TEXT = 256


def abort(context: grpc.ServicerContext, failed: CallFailed) -> None:
    """Ends a call with the status of its failure."""
    failure = failed.failure
    code = OTHER_CODES.get(type(failed), CODES[failure.severity])
    message = shortened(failure.message, LONGEST_MESSAGE)
    details = wire_pb2.Status(code=code.value[0], message=message, details=[error_info(failure)])
    context.set_trailing_metadata([("grpc-status-details-bin", details.SerializeToString())])
    context.abort(code, message)


def error_info(failure: pb.Failure) -> wire_pb2.Any:
    """Severity, field, variable, time and step of a failure, as far as it has them."""
    present = [name for name in ("field", "variable", "t", "step") if failure.HasField(name)]
    metadata = {name: shortened(str(getattr(failure, name)), LONGEST_TEXT) for name in present}
    info = wire_pb2.ErrorInfo(reason=pb.Severity.Name(failure.severity), domain=DOMAIN, metadata=metadata)
    return wire_pb2.Any(type_url="type.googleapis.com/google.rpc.ErrorInfo", value=info.SerializeToString())


def shortened(text: str, longest: int) -> str:
    """The text, or as much of it as `longest` bytes hold and how much is missing."""
    encoded = text.encode()
    if len(encoded) <= longest:
        return text
    kept = encoded[:longest].decode(errors="ignore")
    return f"{kept} ... ({len(encoded) - len(kept.encode())} more bytes)"
