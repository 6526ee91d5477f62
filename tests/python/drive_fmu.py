"""Drives an FMU for co-simulation with FMPy, and prints what comes out as JSON with the bits of all numbers.

drive_fmu.py run FMU STEP END [NAME=VALUE ..]    all outputs at every communication point
drive_fmu.py states FMU STEP FILE                a state is taken, given back, and written to FILE
drive_fmu.py resume FMU STEP FILE                goes on from the state in FILE
drive_fmu.py mistakes FMU                        calls that must fail, with what the logger is told
"""

import json
import shutil
import sys

from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
)
from fmpy.fmi2 import calloc, free
from fmpy.fmi3 import FMU3Slave, fmi3LogMessageCallback
from fmpy.validation import validate_fmu

BEFORE, AFTER = 7, 9


def run(path, step, end, *settings):
    start = {name: float(value) for name, value in (text.split("=") for text in settings)}
    rows = simulate_fmu(path, output_interval=float(step), stop_time=float(end), start_values=start)
    names = [name for name in rows.dtype.names if name != "time"]
    return {
        "problems": validate_fmu(path),
        "t": [float(row["time"]) for row in rows],
        "values": {name: [float(row[name]).hex() for row in rows] for name in names},
    }


class Slave:
    """An instance that collects what its logger is told."""

    def __init__(self, path):
        self.folder = extract(path)
        description = read_model_description(path)
        outputs = [own for own in description.modelVariables if own.causality == "output"]
        self.outputs = [own.valueReference for own in outputs]
        self.told = []
        self.is_two = description.fmiVersion == "2.0"
        kind = FMU2Slave if self.is_two else FMU3Slave
        self.fmu = kind(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="one",
        )
        if self.is_two:
            self.callbacks = fmi2CallbackFunctions()
            self.callbacks.logger = fmi2CallbackLoggerTYPE(self.log_two)
            self.callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
            self.callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)
            self.fmu.instantiate(callbacks=self.callbacks)
        else:
            self.logger = fmi3LogMessageCallback(self.log_three)
            self.fmu.instantiate(logMessage=self.logger)

    def log_two(self, environment, name, status, category, message):
        self.told.append(message.decode())

    def log_three(self, environment, status, category, message):
        self.told.append(message.decode())

    def set_up(self, t):
        if self.is_two:
            self.fmu.setupExperiment(startTime=t)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=t)

    def start(self):
        self.set_up(0.0)
        self.fmu.exitInitializationMode()

    def get(self, references):
        return self.fmu.getReal(references) if self.is_two else self.fmu.getFloat64(references)

    def set(self, references, values):
        (self.fmu.setReal if self.is_two else self.fmu.setFloat64)(references, values)

    def values(self):
        return [value.hex() for value in self.get(self.outputs)]

    def steps(self, first, count, step):
        found = []
        for number in range(first, first + count):
            self.fmu.doStep(number * step, step)
            found.append(self.values())
        return found

    def end(self):
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder)


def states(path, step, file):
    step = float(step)
    slave = Slave(path)
    slave.start()
    before = slave.steps(0, BEFORE, step)
    state = slave.fmu.getFMUState()
    with open(file, "wb") as out:
        out.write(slave.fmu.serializeFMUState(state))
    once = slave.steps(BEFORE, AFTER, step)
    slave.fmu.setFMUState(state)
    again = slave.steps(BEFORE, AFTER, step)
    slave.fmu.freeFMUState(state)
    slave.fmu.reset()
    slave.start()
    anew = slave.steps(0, BEFORE, step)
    slave.end()
    return {"before": before, "anew": anew, "once": once, "again": again}


def resume(path, step, file):
    slave = Slave(path)
    slave.start()
    with open(file, "rb") as kept:
        state = slave.fmu.deserializeFMUState(kept.read())
    slave.fmu.setFMUState(state)
    found = slave.steps(BEFORE, AFTER, float(step))
    slave.end()
    return {"again": found}


def mistakes(path):
    told = {}

    def fails(name, slave, call):
        try:
            call()
        except Exception:
            told[name] = slave.told[-1] if slave.told else ""
        else:
            told[name] = None

    slave = Slave(path)
    fails("too early", slave, lambda: slave.fmu.doStep(0.0, 1e-3))
    fails("start time", slave, lambda: slave.set_up(1.0))
    slave.start()
    fails("another time", slave, lambda: slave.fmu.doStep(0.5, 1e-3))
    fails("no step", slave, lambda: slave.fmu.doStep(0.0, 0.0))
    slave.steps(0, 1, 1e-3)
    fails("too late", slave, lambda: slave.set([len(slave.outputs)], [1.0]))
    fails("no variable", slave, lambda: slave.get([1000]))
    fails("no state", slave, lambda: slave.fmu.deserializeFMUState(b"nonsense"))
    slave.end()
    return told


if __name__ == "__main__":
    commands = {"run": run, "states": states, "resume": resume, "mistakes": mistakes}
    print(json.dumps(commands[sys.argv[1]](*sys.argv[2:])))
