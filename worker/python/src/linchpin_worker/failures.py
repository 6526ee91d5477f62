"""Why a call has no answer, as solvers raise it and as masters are told."""

from ._contract import worker_pb2 as pb


class Refused(Exception):
    """What a scene asks of the model cannot be: raise it where an instance is made.

    `field` is the place in the scene's subsystem, such as "parameters.m"; `reason` says what is allowed and what to do. The
    message is the field, then `between`, then the reason.
    """

    def __init__(self, field: str, reason: str, between: str = ": ") -> None:
        super().__init__(f"{field}{between}{reason}")
        self.field = field


class StepFailed(Exception):
    """The solver could not step, and a smaller macro step may help. `t` (s) is where it stopped, if it can be said.

    Errors of arithmetic (`ArithmeticError`: overflow, division by zero) mean the same. Any other exception ends the run.
    """

    def __init__(self, message: str, t: float | None = None) -> None:
        super().__init__(message)
        self.t = t


class CallFailed(Exception):
    """A call ends with a failure of the contract."""

    def __init__(self, failure: pb.Failure) -> None:
        super().__init__(failure.message)
        self.failure = failure


class NoInstance(CallFailed):
    """There is no such instance here, or not any more: the master has to make it anew."""

    def __init__(self, instance: int) -> None:
        text = f"there is no instance {instance:#x} here; Initialize makes one"
        super().__init__(pb.Failure(severity=pb.SEVERITY_MISUSE, message=text, field="instance"))


class Denied(CallFailed):
    """The instance is not the caller's."""

    def __init__(self, instance: int) -> None:
        text = f"instance {instance:#x} belongs to another certificate: only the master that made it may use or end it"
        super().__init__(pb.Failure(severity=pb.SEVERITY_FATAL, message=text))


def misuse(field: str, message: str) -> CallFailed:
    """The request was wrong: `field` is what must change."""
    return CallFailed(pb.Failure(severity=pb.SEVERITY_MISUSE, message=message, field=field))


def recoverable(message: str, t: float, step: float, variable: str | None = None) -> CallFailed:
    """A step from `t` (s) over `step` (s) failed, and a smaller one may help."""
    severity = pb.SEVERITY_RECOVERABLE
    return CallFailed(pb.Failure(severity=severity, message=message, t=t, step=step, variable=variable))


def fatal(message: str, t: float | None = None, step: float | None = None, variable: str | None = None) -> CallFailed:
    """The instance cannot go on."""
    return CallFailed(pb.Failure(severity=pb.SEVERITY_FATAL, message=message, t=t, step=step, variable=variable))
