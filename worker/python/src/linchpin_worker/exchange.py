"""The fused macro step: go back, advance, evaluate, look ahead."""

from __future__ import annotations

from ._contract import worker_pb2 as pb
from .failures import CallFailed
from .impacts import impacts_of
from .interval import Interval, check_inside, interval_of_evaluation, interval_of_look, interval_of_step
from .motion import Base, Motion


def exchange(motion: Motion, request: pb.ExchangeRequest) -> pb.ExchangeReply:
    """Carries out one request; if it fails the committed state is the one before it."""
    if not request.go_back:
        return _advance_and_look_ahead(motion, request)
    taken_back = motion.take_back()
    try:
        return _advance_and_look_ahead(motion, request)
    except CallFailed:
        motion.stay(taken_back)
        raise


def _advance_and_look_ahead(motion: Motion, request: pb.ExchangeRequest) -> pb.ExchangeReply:
    reply = pb.ExchangeReply(sequence=request.sequence, instance=request.instance)
    base = Base.COMMITTED
    if request.HasField("advance"):
        _advance(motion, request.advance, reply)
        base = Base.ADVANCED
    if request.HasField("evaluate"):
        evaluate = request.evaluate
        values, perturbed, derivatives = _look(motion, base, evaluate, interval_of_evaluation(evaluate))
        reply.evaluated.values.extend(values)
        reply.evaluated_perturbed.extend(perturbed)
        reply.evaluated_derivatives.extend(derivatives)
    if request.HasField("predict"):
        predict = request.predict
        values, perturbed, derivatives = _look(motion, base, predict, interval_of_look(predict))
        reply.predicted.values.extend(values)
        reply.perturbed.extend(perturbed)
        reply.derivatives.extend(derivatives)
    if base is Base.ADVANCED:
        motion.commit()
    return reply


def _advance(motion: Motion, advance: pb.Advance, reply: pb.ExchangeReply) -> None:
    interval = interval_of_step(advance.t, advance.step)
    check_inside("advance.samples", "sample", advance.samples, advance.step)
    motion.take(advance.signals, advance.integrals, impacts_of(advance))
    reply.advanced.values.extend(motion.advance(interval, advance.instants, pb.OUTPUT_SET_ALL))
    for sample in advance.samples:
        reply.samples.add(values=motion.sample(Interval(advance.t, sample)))


def _look(
    motion: Motion, base: Base, look: pb.Predict, interval: Interval
) -> tuple[list[float], list[pb.Outputs], list[pb.Outputs]]:
    motion.take(look.signals, look.integrals, impacts_of(look))
    values, perturbed = motion.look_ahead(base, interval, look.instants, look.perturbed)
    return values, perturbed, motion.look_in_directions(base, interval, look.instants, look.directions)
