from google.protobuf.internal import containers as _containers
from google.protobuf.internal import enum_type_wrapper as _enum_type_wrapper
from google.protobuf import descriptor as _descriptor
from google.protobuf import message as _message
from collections.abc import Iterable as _Iterable, Mapping as _Mapping
from typing import ClassVar as _ClassVar, Optional as _Optional, Union as _Union

DESCRIPTOR: _descriptor.FileDescriptor

class MarkerKind(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    MARKER_KIND_UNSPECIFIED: _ClassVar[MarkerKind]
    MARKER_KIND_SCALAR: _ClassVar[MarkerKind]
    MARKER_KIND_PLANAR: _ClassVar[MarkerKind]
    MARKER_KIND_SPATIAL: _ClassVar[MarkerKind]

class JointLaw(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    JOINT_LAW_UNSPECIFIED: _ClassVar[JointLaw]
    JOINT_LAW_ATPOINT: _ClassVar[JointLaw]
    JOINT_LAW_INPLANE: _ClassVar[JointLaw]
    JOINT_LAW_PERPENDICULAR: _ClassVar[JointLaw]

class JointEnd(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    JOINT_END_UNSPECIFIED: _ClassVar[JointEnd]
    JOINT_END_A: _ClassVar[JointEnd]
    JOINT_END_B: _ClassVar[JointEnd]

class OutputSet(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    OUTPUT_SET_COUPLING: _ClassVar[OutputSet]
    OUTPUT_SET_ALL: _ClassVar[OutputSet]

class Severity(int, metaclass=_enum_type_wrapper.EnumTypeWrapper):
    __slots__ = ()
    SEVERITY_FATAL: _ClassVar[Severity]
    SEVERITY_RECOVERABLE: _ClassVar[Severity]
    SEVERITY_MISUSE: _ClassVar[Severity]
MARKER_KIND_UNSPECIFIED: MarkerKind
MARKER_KIND_SCALAR: MarkerKind
MARKER_KIND_PLANAR: MarkerKind
MARKER_KIND_SPATIAL: MarkerKind
JOINT_LAW_UNSPECIFIED: JointLaw
JOINT_LAW_ATPOINT: JointLaw
JOINT_LAW_INPLANE: JointLaw
JOINT_LAW_PERPENDICULAR: JointLaw
JOINT_END_UNSPECIFIED: JointEnd
JOINT_END_A: JointEnd
JOINT_END_B: JointEnd
OUTPUT_SET_COUPLING: OutputSet
OUTPUT_SET_ALL: OutputSet
SEVERITY_FATAL: Severity
SEVERITY_RECOVERABLE: Severity
SEVERITY_MISUSE: Severity

class ProtocolVersion(_message.Message):
    __slots__ = ("major", "minor")
    MAJOR_FIELD_NUMBER: _ClassVar[int]
    MINOR_FIELD_NUMBER: _ClassVar[int]
    major: int
    minor: int
    def __init__(self, major: _Optional[int] = ..., minor: _Optional[int] = ...) -> None: ...

class DescribeRequest(_message.Message):
    __slots__ = ("protocol", "model", "parameters")
    class ParametersEntry(_message.Message):
        __slots__ = ("key", "value")
        KEY_FIELD_NUMBER: _ClassVar[int]
        VALUE_FIELD_NUMBER: _ClassVar[int]
        key: str
        value: Value
        def __init__(self, key: _Optional[str] = ..., value: _Optional[_Union[Value, _Mapping]] = ...) -> None: ...
    PROTOCOL_FIELD_NUMBER: _ClassVar[int]
    MODEL_FIELD_NUMBER: _ClassVar[int]
    PARAMETERS_FIELD_NUMBER: _ClassVar[int]
    protocol: ProtocolVersion
    model: str
    parameters: _containers.MessageMap[str, Value]
    def __init__(self, protocol: _Optional[_Union[ProtocolVersion, _Mapping]] = ..., model: _Optional[str] = ..., parameters: _Optional[_Mapping[str, Value]] = ...) -> None: ...

class DescribeReply(_message.Message):
    __slots__ = ("protocol", "worker", "worker_version", "models")
    PROTOCOL_FIELD_NUMBER: _ClassVar[int]
    WORKER_FIELD_NUMBER: _ClassVar[int]
    WORKER_VERSION_FIELD_NUMBER: _ClassVar[int]
    MODELS_FIELD_NUMBER: _ClassVar[int]
    protocol: ProtocolVersion
    worker: str
    worker_version: str
    models: _containers.RepeatedCompositeFieldContainer[Model]
    def __init__(self, protocol: _Optional[_Union[ProtocolVersion, _Mapping]] = ..., worker: _Optional[str] = ..., worker_version: _Optional[str] = ..., models: _Optional[_Iterable[_Union[Model, _Mapping]]] = ...) -> None: ...

class Model(_message.Message):
    __slots__ = ("name", "description", "inputs", "outputs", "parameters", "markers", "solvers", "states", "capabilities", "forward_only")
    NAME_FIELD_NUMBER: _ClassVar[int]
    DESCRIPTION_FIELD_NUMBER: _ClassVar[int]
    INPUTS_FIELD_NUMBER: _ClassVar[int]
    OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    PARAMETERS_FIELD_NUMBER: _ClassVar[int]
    MARKERS_FIELD_NUMBER: _ClassVar[int]
    SOLVERS_FIELD_NUMBER: _ClassVar[int]
    STATES_FIELD_NUMBER: _ClassVar[int]
    CAPABILITIES_FIELD_NUMBER: _ClassVar[int]
    FORWARD_ONLY_FIELD_NUMBER: _ClassVar[int]
    name: str
    description: str
    inputs: _containers.RepeatedCompositeFieldContainer[Variable]
    outputs: _containers.RepeatedCompositeFieldContainer[Variable]
    parameters: _containers.RepeatedCompositeFieldContainer[Parameter]
    markers: _containers.RepeatedCompositeFieldContainer[Marker]
    solvers: _containers.RepeatedCompositeFieldContainer[SolverKind]
    states: _containers.RepeatedCompositeFieldContainer[StateVariable]
    capabilities: Capabilities
    forward_only: str
    def __init__(self, name: _Optional[str] = ..., description: _Optional[str] = ..., inputs: _Optional[_Iterable[_Union[Variable, _Mapping]]] = ..., outputs: _Optional[_Iterable[_Union[Variable, _Mapping]]] = ..., parameters: _Optional[_Iterable[_Union[Parameter, _Mapping]]] = ..., markers: _Optional[_Iterable[_Union[Marker, _Mapping]]] = ..., solvers: _Optional[_Iterable[_Union[SolverKind, _Mapping]]] = ..., states: _Optional[_Iterable[_Union[StateVariable, _Mapping]]] = ..., capabilities: _Optional[_Union[Capabilities, _Mapping]] = ..., forward_only: _Optional[str] = ...) -> None: ...

class Variable(_message.Message):
    __slots__ = ("name", "unit", "description", "default")
    NAME_FIELD_NUMBER: _ClassVar[int]
    UNIT_FIELD_NUMBER: _ClassVar[int]
    DESCRIPTION_FIELD_NUMBER: _ClassVar[int]
    DEFAULT_FIELD_NUMBER: _ClassVar[int]
    name: str
    unit: str
    description: str
    default: float
    def __init__(self, name: _Optional[str] = ..., unit: _Optional[str] = ..., description: _Optional[str] = ..., default: _Optional[float] = ...) -> None: ...

class Parameter(_message.Message):
    __slots__ = ("name", "unit", "description", "default")
    NAME_FIELD_NUMBER: _ClassVar[int]
    UNIT_FIELD_NUMBER: _ClassVar[int]
    DESCRIPTION_FIELD_NUMBER: _ClassVar[int]
    DEFAULT_FIELD_NUMBER: _ClassVar[int]
    name: str
    unit: str
    description: str
    default: float
    def __init__(self, name: _Optional[str] = ..., unit: _Optional[str] = ..., description: _Optional[str] = ..., default: _Optional[float] = ...) -> None: ...

class SolverKind(_message.Message):
    __slots__ = ("name", "description", "options", "without_impacts")
    NAME_FIELD_NUMBER: _ClassVar[int]
    DESCRIPTION_FIELD_NUMBER: _ClassVar[int]
    OPTIONS_FIELD_NUMBER: _ClassVar[int]
    WITHOUT_IMPACTS_FIELD_NUMBER: _ClassVar[int]
    name: str
    description: str
    options: _containers.RepeatedCompositeFieldContainer[Parameter]
    without_impacts: bool
    def __init__(self, name: _Optional[str] = ..., description: _Optional[str] = ..., options: _Optional[_Iterable[_Union[Parameter, _Mapping]]] = ..., without_impacts: _Optional[bool] = ...) -> None: ...

class Marker(_message.Message):
    __slots__ = ("name", "kind", "position", "velocity", "acceleration", "load")
    NAME_FIELD_NUMBER: _ClassVar[int]
    KIND_FIELD_NUMBER: _ClassVar[int]
    POSITION_FIELD_NUMBER: _ClassVar[int]
    VELOCITY_FIELD_NUMBER: _ClassVar[int]
    ACCELERATION_FIELD_NUMBER: _ClassVar[int]
    LOAD_FIELD_NUMBER: _ClassVar[int]
    name: str
    kind: MarkerKind
    position: _containers.RepeatedScalarFieldContainer[str]
    velocity: _containers.RepeatedScalarFieldContainer[str]
    acceleration: _containers.RepeatedScalarFieldContainer[str]
    load: _containers.RepeatedScalarFieldContainer[str]
    def __init__(self, name: _Optional[str] = ..., kind: _Optional[_Union[MarkerKind, str]] = ..., position: _Optional[_Iterable[str]] = ..., velocity: _Optional[_Iterable[str]] = ..., acceleration: _Optional[_Iterable[str]] = ..., load: _Optional[_Iterable[str]] = ...) -> None: ...

class StateVariable(_message.Message):
    __slots__ = ("output", "initial")
    OUTPUT_FIELD_NUMBER: _ClassVar[int]
    INITIAL_FIELD_NUMBER: _ClassVar[int]
    output: str
    initial: str
    def __init__(self, output: _Optional[str] = ..., initial: _Optional[str] = ...) -> None: ...

class Capabilities(_message.Message):
    __slots__ = ("exchange", "repeats_step_sequence", "max_input_degree", "exportable_snapshot", "joint_loads", "directional_derivatives", "interior_outputs", "output_integrals", "impulses", "impacts")
    EXCHANGE_FIELD_NUMBER: _ClassVar[int]
    REPEATS_STEP_SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    MAX_INPUT_DEGREE_FIELD_NUMBER: _ClassVar[int]
    EXPORTABLE_SNAPSHOT_FIELD_NUMBER: _ClassVar[int]
    JOINT_LOADS_FIELD_NUMBER: _ClassVar[int]
    DIRECTIONAL_DERIVATIVES_FIELD_NUMBER: _ClassVar[int]
    INTERIOR_OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    OUTPUT_INTEGRALS_FIELD_NUMBER: _ClassVar[int]
    IMPULSES_FIELD_NUMBER: _ClassVar[int]
    IMPACTS_FIELD_NUMBER: _ClassVar[int]
    exchange: bool
    repeats_step_sequence: bool
    max_input_degree: int
    exportable_snapshot: bool
    joint_loads: bool
    directional_derivatives: bool
    interior_outputs: bool
    output_integrals: bool
    impulses: bool
    impacts: bool
    def __init__(self, exchange: _Optional[bool] = ..., repeats_step_sequence: _Optional[bool] = ..., max_input_degree: _Optional[int] = ..., exportable_snapshot: _Optional[bool] = ..., joint_loads: _Optional[bool] = ..., directional_derivatives: _Optional[bool] = ..., interior_outputs: _Optional[bool] = ..., output_integrals: _Optional[bool] = ..., impulses: _Optional[bool] = ..., impacts: _Optional[bool] = ...) -> None: ...

class Impact(_message.Message):
    __slots__ = ("at", "contacts", "loads", "multipliers")
    AT_FIELD_NUMBER: _ClassVar[int]
    CONTACTS_FIELD_NUMBER: _ClassVar[int]
    LOADS_FIELD_NUMBER: _ClassVar[int]
    MULTIPLIERS_FIELD_NUMBER: _ClassVar[int]
    at: float
    contacts: _containers.RepeatedScalarFieldContainer[int]
    loads: _containers.RepeatedScalarFieldContainer[float]
    multipliers: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, at: _Optional[float] = ..., contacts: _Optional[_Iterable[int]] = ..., loads: _Optional[_Iterable[float]] = ..., multipliers: _Optional[_Iterable[float]] = ...) -> None: ...

class Impacts(_message.Message):
    __slots__ = ("impacts",)
    IMPACTS_FIELD_NUMBER: _ClassVar[int]
    impacts: _containers.RepeatedCompositeFieldContainer[Impact]
    def __init__(self, impacts: _Optional[_Iterable[_Union[Impact, _Mapping]]] = ...) -> None: ...

class Interface(_message.Message):
    __slots__ = ("rows", "directions", "mobility")
    ROWS_FIELD_NUMBER: _ClassVar[int]
    DIRECTIONS_FIELD_NUMBER: _ClassVar[int]
    MOBILITY_FIELD_NUMBER: _ClassVar[int]
    rows: int
    directions: _containers.RepeatedScalarFieldContainer[float]
    mobility: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, rows: _Optional[int] = ..., directions: _Optional[_Iterable[float]] = ..., mobility: _Optional[_Iterable[float]] = ...) -> None: ...

class Value(_message.Message):
    __slots__ = ("number", "text", "flag", "numbers")
    NUMBER_FIELD_NUMBER: _ClassVar[int]
    TEXT_FIELD_NUMBER: _ClassVar[int]
    FLAG_FIELD_NUMBER: _ClassVar[int]
    NUMBERS_FIELD_NUMBER: _ClassVar[int]
    number: float
    text: str
    flag: bool
    numbers: NumberList
    def __init__(self, number: _Optional[float] = ..., text: _Optional[str] = ..., flag: _Optional[bool] = ..., numbers: _Optional[_Union[NumberList, _Mapping]] = ...) -> None: ...

class NumberList(_message.Message):
    __slots__ = ("values",)
    VALUES_FIELD_NUMBER: _ClassVar[int]
    values: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, values: _Optional[_Iterable[float]] = ...) -> None: ...

class Solver(_message.Message):
    __slots__ = ("kind", "options")
    class OptionsEntry(_message.Message):
        __slots__ = ("key", "value")
        KEY_FIELD_NUMBER: _ClassVar[int]
        VALUE_FIELD_NUMBER: _ClassVar[int]
        key: str
        value: Value
        def __init__(self, key: _Optional[str] = ..., value: _Optional[_Union[Value, _Mapping]] = ...) -> None: ...
    KIND_FIELD_NUMBER: _ClassVar[int]
    OPTIONS_FIELD_NUMBER: _ClassVar[int]
    kind: str
    options: _containers.MessageMap[str, Value]
    def __init__(self, kind: _Optional[str] = ..., options: _Optional[_Mapping[str, Value]] = ...) -> None: ...

class InitializeRequest(_message.Message):
    __slots__ = ("instance", "sequence", "protocol", "model", "parameters", "solver", "t_start", "inputs", "coupling_outputs", "recorded_outputs", "joint_inputs", "joint_loads", "interior_outputs", "integrated_outputs")
    class ParametersEntry(_message.Message):
        __slots__ = ("key", "value")
        KEY_FIELD_NUMBER: _ClassVar[int]
        VALUE_FIELD_NUMBER: _ClassVar[int]
        key: str
        value: Value
        def __init__(self, key: _Optional[str] = ..., value: _Optional[_Union[Value, _Mapping]] = ...) -> None: ...
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    PROTOCOL_FIELD_NUMBER: _ClassVar[int]
    MODEL_FIELD_NUMBER: _ClassVar[int]
    PARAMETERS_FIELD_NUMBER: _ClassVar[int]
    SOLVER_FIELD_NUMBER: _ClassVar[int]
    T_START_FIELD_NUMBER: _ClassVar[int]
    INPUTS_FIELD_NUMBER: _ClassVar[int]
    COUPLING_OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    RECORDED_OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    JOINT_INPUTS_FIELD_NUMBER: _ClassVar[int]
    JOINT_LOADS_FIELD_NUMBER: _ClassVar[int]
    INTERIOR_OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    INTEGRATED_OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    instance: int
    sequence: int
    protocol: ProtocolVersion
    model: str
    parameters: _containers.MessageMap[str, Value]
    solver: Solver
    t_start: float
    inputs: _containers.RepeatedScalarFieldContainer[str]
    coupling_outputs: _containers.RepeatedScalarFieldContainer[str]
    recorded_outputs: _containers.RepeatedScalarFieldContainer[str]
    joint_inputs: _containers.RepeatedScalarFieldContainer[str]
    joint_loads: _containers.RepeatedCompositeFieldContainer[JointLoad]
    interior_outputs: _containers.RepeatedScalarFieldContainer[str]
    integrated_outputs: _containers.RepeatedScalarFieldContainer[str]
    def __init__(self, instance: _Optional[int] = ..., sequence: _Optional[int] = ..., protocol: _Optional[_Union[ProtocolVersion, _Mapping]] = ..., model: _Optional[str] = ..., parameters: _Optional[_Mapping[str, Value]] = ..., solver: _Optional[_Union[Solver, _Mapping]] = ..., t_start: _Optional[float] = ..., inputs: _Optional[_Iterable[str]] = ..., coupling_outputs: _Optional[_Iterable[str]] = ..., recorded_outputs: _Optional[_Iterable[str]] = ..., joint_inputs: _Optional[_Iterable[str]] = ..., joint_loads: _Optional[_Iterable[_Union[JointLoad, _Mapping]]] = ..., interior_outputs: _Optional[_Iterable[str]] = ..., integrated_outputs: _Optional[_Iterable[str]] = ...) -> None: ...

class JointLoad(_message.Message):
    __slots__ = ("marker", "law", "end", "point_a", "point_b", "axis_a", "axis_b", "multiplier", "partner_position", "partner_rotation", "partner_attitude")
    MARKER_FIELD_NUMBER: _ClassVar[int]
    LAW_FIELD_NUMBER: _ClassVar[int]
    END_FIELD_NUMBER: _ClassVar[int]
    POINT_A_FIELD_NUMBER: _ClassVar[int]
    POINT_B_FIELD_NUMBER: _ClassVar[int]
    AXIS_A_FIELD_NUMBER: _ClassVar[int]
    AXIS_B_FIELD_NUMBER: _ClassVar[int]
    MULTIPLIER_FIELD_NUMBER: _ClassVar[int]
    PARTNER_POSITION_FIELD_NUMBER: _ClassVar[int]
    PARTNER_ROTATION_FIELD_NUMBER: _ClassVar[int]
    PARTNER_ATTITUDE_FIELD_NUMBER: _ClassVar[int]
    marker: str
    law: JointLaw
    end: JointEnd
    point_a: _containers.RepeatedScalarFieldContainer[float]
    point_b: _containers.RepeatedScalarFieldContainer[float]
    axis_a: _containers.RepeatedScalarFieldContainer[float]
    axis_b: _containers.RepeatedScalarFieldContainer[float]
    multiplier: int
    partner_position: _containers.RepeatedScalarFieldContainer[int]
    partner_rotation: _containers.RepeatedScalarFieldContainer[int]
    partner_attitude: _containers.RepeatedScalarFieldContainer[int]
    def __init__(self, marker: _Optional[str] = ..., law: _Optional[_Union[JointLaw, str]] = ..., end: _Optional[_Union[JointEnd, str]] = ..., point_a: _Optional[_Iterable[float]] = ..., point_b: _Optional[_Iterable[float]] = ..., axis_a: _Optional[_Iterable[float]] = ..., axis_b: _Optional[_Iterable[float]] = ..., multiplier: _Optional[int] = ..., partner_position: _Optional[_Iterable[int]] = ..., partner_rotation: _Optional[_Iterable[int]] = ..., partner_attitude: _Optional[_Iterable[int]] = ...) -> None: ...

class InitializeReply(_message.Message):
    __slots__ = ("tolerance", "instance", "sequence", "lease")
    TOLERANCE_FIELD_NUMBER: _ClassVar[int]
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    LEASE_FIELD_NUMBER: _ClassVar[int]
    tolerance: float
    instance: int
    sequence: int
    lease: float
    def __init__(self, tolerance: _Optional[float] = ..., instance: _Optional[int] = ..., sequence: _Optional[int] = ..., lease: _Optional[float] = ...) -> None: ...

class SnapshotRequest(_message.Message):
    __slots__ = ("instance", "sequence", "replaces")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    REPLACES_FIELD_NUMBER: _ClassVar[int]
    instance: int
    sequence: int
    replaces: int
    def __init__(self, instance: _Optional[int] = ..., sequence: _Optional[int] = ..., replaces: _Optional[int] = ...) -> None: ...

class SnapshotReply(_message.Message):
    __slots__ = ("snapshot", "instance", "sequence")
    SNAPSHOT_FIELD_NUMBER: _ClassVar[int]
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    snapshot: int
    instance: int
    sequence: int
    def __init__(self, snapshot: _Optional[int] = ..., instance: _Optional[int] = ..., sequence: _Optional[int] = ...) -> None: ...

class RestoreRequest(_message.Message):
    __slots__ = ("instance", "sequence", "snapshot")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    SNAPSHOT_FIELD_NUMBER: _ClassVar[int]
    instance: int
    sequence: int
    snapshot: int
    def __init__(self, instance: _Optional[int] = ..., sequence: _Optional[int] = ..., snapshot: _Optional[int] = ...) -> None: ...

class RestoreReply(_message.Message):
    __slots__ = ("instance", "sequence")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    instance: int
    sequence: int
    def __init__(self, instance: _Optional[int] = ..., sequence: _Optional[int] = ...) -> None: ...

class ExportedState(_message.Message):
    __slots__ = ("model", "writer", "state", "checksum")
    MODEL_FIELD_NUMBER: _ClassVar[int]
    WRITER_FIELD_NUMBER: _ClassVar[int]
    STATE_FIELD_NUMBER: _ClassVar[int]
    CHECKSUM_FIELD_NUMBER: _ClassVar[int]
    model: str
    writer: str
    state: bytes
    checksum: int
    def __init__(self, model: _Optional[str] = ..., writer: _Optional[str] = ..., state: _Optional[bytes] = ..., checksum: _Optional[int] = ...) -> None: ...

class ExportStateRequest(_message.Message):
    __slots__ = ("instance",)
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    instance: int
    def __init__(self, instance: _Optional[int] = ...) -> None: ...

class ExportStateReply(_message.Message):
    __slots__ = ("state", "instance")
    STATE_FIELD_NUMBER: _ClassVar[int]
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    state: ExportedState
    instance: int
    def __init__(self, state: _Optional[_Union[ExportedState, _Mapping]] = ..., instance: _Optional[int] = ...) -> None: ...

class ImportStateRequest(_message.Message):
    __slots__ = ("instance", "sequence", "state")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    STATE_FIELD_NUMBER: _ClassVar[int]
    instance: int
    sequence: int
    state: ExportedState
    def __init__(self, instance: _Optional[int] = ..., sequence: _Optional[int] = ..., state: _Optional[_Union[ExportedState, _Mapping]] = ...) -> None: ...

class ImportStateReply(_message.Message):
    __slots__ = ("instance", "sequence")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    instance: int
    sequence: int
    def __init__(self, instance: _Optional[int] = ..., sequence: _Optional[int] = ...) -> None: ...

class Signal(_message.Message):
    __slots__ = ("input", "nodes", "values")
    INPUT_FIELD_NUMBER: _ClassVar[int]
    NODES_FIELD_NUMBER: _ClassVar[int]
    VALUES_FIELD_NUMBER: _ClassVar[int]
    input: int
    nodes: _containers.RepeatedScalarFieldContainer[float]
    values: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, input: _Optional[int] = ..., nodes: _Optional[_Iterable[float]] = ..., values: _Optional[_Iterable[float]] = ...) -> None: ...

class Outputs(_message.Message):
    __slots__ = ("values",)
    VALUES_FIELD_NUMBER: _ClassVar[int]
    values: _containers.RepeatedScalarFieldContainer[float]
    def __init__(self, values: _Optional[_Iterable[float]] = ...) -> None: ...

class StepRequest(_message.Message):
    __slots__ = ("instance", "sequence", "t", "step", "signals", "outputs", "instants", "integrals", "impacts", "interface")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    T_FIELD_NUMBER: _ClassVar[int]
    STEP_FIELD_NUMBER: _ClassVar[int]
    SIGNALS_FIELD_NUMBER: _ClassVar[int]
    OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    INSTANTS_FIELD_NUMBER: _ClassVar[int]
    INTEGRALS_FIELD_NUMBER: _ClassVar[int]
    IMPACTS_FIELD_NUMBER: _ClassVar[int]
    INTERFACE_FIELD_NUMBER: _ClassVar[int]
    instance: int
    sequence: int
    t: float
    step: float
    signals: _containers.RepeatedCompositeFieldContainer[Signal]
    outputs: OutputSet
    instants: _containers.RepeatedScalarFieldContainer[float]
    integrals: int
    impacts: Impacts
    interface: Interface
    def __init__(self, instance: _Optional[int] = ..., sequence: _Optional[int] = ..., t: _Optional[float] = ..., step: _Optional[float] = ..., signals: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ..., outputs: _Optional[_Union[OutputSet, str]] = ..., instants: _Optional[_Iterable[float]] = ..., integrals: _Optional[int] = ..., impacts: _Optional[_Union[Impacts, _Mapping]] = ..., interface: _Optional[_Union[Interface, _Mapping]] = ...) -> None: ...

class StepReply(_message.Message):
    __slots__ = ("outputs", "work", "instance", "sequence", "impacts")
    OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    WORK_FIELD_NUMBER: _ClassVar[int]
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    IMPACTS_FIELD_NUMBER: _ClassVar[int]
    outputs: Outputs
    work: Work
    instance: int
    sequence: int
    impacts: Impacts
    def __init__(self, outputs: _Optional[_Union[Outputs, _Mapping]] = ..., work: _Optional[_Union[Work, _Mapping]] = ..., instance: _Optional[int] = ..., sequence: _Optional[int] = ..., impacts: _Optional[_Union[Impacts, _Mapping]] = ...) -> None: ...

class PerturbedStepRequest(_message.Message):
    __slots__ = ("instance", "sequence", "t", "step", "signals", "perturbed", "directions", "instants", "integrals", "impacts", "interface")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    T_FIELD_NUMBER: _ClassVar[int]
    STEP_FIELD_NUMBER: _ClassVar[int]
    SIGNALS_FIELD_NUMBER: _ClassVar[int]
    PERTURBED_FIELD_NUMBER: _ClassVar[int]
    DIRECTIONS_FIELD_NUMBER: _ClassVar[int]
    INSTANTS_FIELD_NUMBER: _ClassVar[int]
    INTEGRALS_FIELD_NUMBER: _ClassVar[int]
    IMPACTS_FIELD_NUMBER: _ClassVar[int]
    INTERFACE_FIELD_NUMBER: _ClassVar[int]
    instance: int
    sequence: int
    t: float
    step: float
    signals: _containers.RepeatedCompositeFieldContainer[Signal]
    perturbed: _containers.RepeatedCompositeFieldContainer[Signal]
    directions: _containers.RepeatedCompositeFieldContainer[Signal]
    instants: _containers.RepeatedScalarFieldContainer[float]
    integrals: int
    impacts: Impacts
    interface: Interface
    def __init__(self, instance: _Optional[int] = ..., sequence: _Optional[int] = ..., t: _Optional[float] = ..., step: _Optional[float] = ..., signals: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ..., perturbed: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ..., directions: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ..., instants: _Optional[_Iterable[float]] = ..., integrals: _Optional[int] = ..., impacts: _Optional[_Union[Impacts, _Mapping]] = ..., interface: _Optional[_Union[Interface, _Mapping]] = ...) -> None: ...

class PerturbedStepReply(_message.Message):
    __slots__ = ("outputs", "work", "derivatives", "instance", "sequence")
    OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    WORK_FIELD_NUMBER: _ClassVar[int]
    DERIVATIVES_FIELD_NUMBER: _ClassVar[int]
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    outputs: _containers.RepeatedCompositeFieldContainer[Outputs]
    work: Work
    derivatives: _containers.RepeatedCompositeFieldContainer[Outputs]
    instance: int
    sequence: int
    def __init__(self, outputs: _Optional[_Iterable[_Union[Outputs, _Mapping]]] = ..., work: _Optional[_Union[Work, _Mapping]] = ..., derivatives: _Optional[_Iterable[_Union[Outputs, _Mapping]]] = ..., instance: _Optional[int] = ..., sequence: _Optional[int] = ...) -> None: ...

class EvaluateRequest(_message.Message):
    __slots__ = ("instance", "t", "signals", "outputs", "directions")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    T_FIELD_NUMBER: _ClassVar[int]
    SIGNALS_FIELD_NUMBER: _ClassVar[int]
    OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    DIRECTIONS_FIELD_NUMBER: _ClassVar[int]
    instance: int
    t: float
    signals: _containers.RepeatedCompositeFieldContainer[Signal]
    outputs: _containers.RepeatedScalarFieldContainer[str]
    directions: _containers.RepeatedCompositeFieldContainer[Signal]
    def __init__(self, instance: _Optional[int] = ..., t: _Optional[float] = ..., signals: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ..., outputs: _Optional[_Iterable[str]] = ..., directions: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ...) -> None: ...

class EvaluateReply(_message.Message):
    __slots__ = ("outputs", "derivatives", "instance")
    OUTPUTS_FIELD_NUMBER: _ClassVar[int]
    DERIVATIVES_FIELD_NUMBER: _ClassVar[int]
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    outputs: Outputs
    derivatives: _containers.RepeatedCompositeFieldContainer[Outputs]
    instance: int
    def __init__(self, outputs: _Optional[_Union[Outputs, _Mapping]] = ..., derivatives: _Optional[_Iterable[_Union[Outputs, _Mapping]]] = ..., instance: _Optional[int] = ...) -> None: ...

class TerminateRequest(_message.Message):
    __slots__ = ("instance",)
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    instance: int
    def __init__(self, instance: _Optional[int] = ...) -> None: ...

class TerminateReply(_message.Message):
    __slots__ = ("instance",)
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    instance: int
    def __init__(self, instance: _Optional[int] = ...) -> None: ...

class ListInstancesRequest(_message.Message):
    __slots__ = ()
    def __init__(self) -> None: ...

class ListInstancesReply(_message.Message):
    __slots__ = ("instances",)
    INSTANCES_FIELD_NUMBER: _ClassVar[int]
    instances: _containers.RepeatedCompositeFieldContainer[InstanceState]
    def __init__(self, instances: _Optional[_Iterable[_Union[InstanceState, _Mapping]]] = ...) -> None: ...

class InstanceState(_message.Message):
    __slots__ = ("instance", "model", "age", "idle", "held", "expires")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    MODEL_FIELD_NUMBER: _ClassVar[int]
    AGE_FIELD_NUMBER: _ClassVar[int]
    IDLE_FIELD_NUMBER: _ClassVar[int]
    HELD_FIELD_NUMBER: _ClassVar[int]
    EXPIRES_FIELD_NUMBER: _ClassVar[int]
    instance: int
    model: str
    age: float
    idle: float
    held: bool
    expires: float
    def __init__(self, instance: _Optional[int] = ..., model: _Optional[str] = ..., age: _Optional[float] = ..., idle: _Optional[float] = ..., held: _Optional[bool] = ..., expires: _Optional[float] = ...) -> None: ...

class ExchangeRequest(_message.Message):
    __slots__ = ("instance", "sequence", "advance", "predict", "go_back", "evaluate")
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    ADVANCE_FIELD_NUMBER: _ClassVar[int]
    PREDICT_FIELD_NUMBER: _ClassVar[int]
    GO_BACK_FIELD_NUMBER: _ClassVar[int]
    EVALUATE_FIELD_NUMBER: _ClassVar[int]
    instance: int
    sequence: int
    advance: Advance
    predict: Predict
    go_back: bool
    evaluate: Predict
    def __init__(self, instance: _Optional[int] = ..., sequence: _Optional[int] = ..., advance: _Optional[_Union[Advance, _Mapping]] = ..., predict: _Optional[_Union[Predict, _Mapping]] = ..., go_back: _Optional[bool] = ..., evaluate: _Optional[_Union[Predict, _Mapping]] = ...) -> None: ...

class Advance(_message.Message):
    __slots__ = ("t", "step", "signals", "samples", "instants", "integrals", "impacts")
    T_FIELD_NUMBER: _ClassVar[int]
    STEP_FIELD_NUMBER: _ClassVar[int]
    SIGNALS_FIELD_NUMBER: _ClassVar[int]
    SAMPLES_FIELD_NUMBER: _ClassVar[int]
    INSTANTS_FIELD_NUMBER: _ClassVar[int]
    INTEGRALS_FIELD_NUMBER: _ClassVar[int]
    IMPACTS_FIELD_NUMBER: _ClassVar[int]
    t: float
    step: float
    signals: _containers.RepeatedCompositeFieldContainer[Signal]
    samples: _containers.RepeatedScalarFieldContainer[float]
    instants: _containers.RepeatedScalarFieldContainer[float]
    integrals: int
    impacts: Impacts
    def __init__(self, t: _Optional[float] = ..., step: _Optional[float] = ..., signals: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ..., samples: _Optional[_Iterable[float]] = ..., instants: _Optional[_Iterable[float]] = ..., integrals: _Optional[int] = ..., impacts: _Optional[_Union[Impacts, _Mapping]] = ...) -> None: ...

class Predict(_message.Message):
    __slots__ = ("t", "step", "signals", "perturbed", "directions", "instants", "integrals", "impacts", "interface")
    T_FIELD_NUMBER: _ClassVar[int]
    STEP_FIELD_NUMBER: _ClassVar[int]
    SIGNALS_FIELD_NUMBER: _ClassVar[int]
    PERTURBED_FIELD_NUMBER: _ClassVar[int]
    DIRECTIONS_FIELD_NUMBER: _ClassVar[int]
    INSTANTS_FIELD_NUMBER: _ClassVar[int]
    INTEGRALS_FIELD_NUMBER: _ClassVar[int]
    IMPACTS_FIELD_NUMBER: _ClassVar[int]
    INTERFACE_FIELD_NUMBER: _ClassVar[int]
    t: float
    step: float
    signals: _containers.RepeatedCompositeFieldContainer[Signal]
    perturbed: _containers.RepeatedCompositeFieldContainer[Signal]
    directions: _containers.RepeatedCompositeFieldContainer[Signal]
    instants: _containers.RepeatedScalarFieldContainer[float]
    integrals: int
    impacts: Impacts
    interface: Interface
    def __init__(self, t: _Optional[float] = ..., step: _Optional[float] = ..., signals: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ..., perturbed: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ..., directions: _Optional[_Iterable[_Union[Signal, _Mapping]]] = ..., instants: _Optional[_Iterable[float]] = ..., integrals: _Optional[int] = ..., impacts: _Optional[_Union[Impacts, _Mapping]] = ..., interface: _Optional[_Union[Interface, _Mapping]] = ...) -> None: ...

class ExchangeReply(_message.Message):
    __slots__ = ("sequence", "advanced", "predicted", "perturbed", "work", "failure", "samples", "derivatives", "evaluated", "evaluated_perturbed", "evaluated_derivatives", "instance", "impacts")
    SEQUENCE_FIELD_NUMBER: _ClassVar[int]
    ADVANCED_FIELD_NUMBER: _ClassVar[int]
    PREDICTED_FIELD_NUMBER: _ClassVar[int]
    PERTURBED_FIELD_NUMBER: _ClassVar[int]
    WORK_FIELD_NUMBER: _ClassVar[int]
    FAILURE_FIELD_NUMBER: _ClassVar[int]
    SAMPLES_FIELD_NUMBER: _ClassVar[int]
    DERIVATIVES_FIELD_NUMBER: _ClassVar[int]
    EVALUATED_FIELD_NUMBER: _ClassVar[int]
    EVALUATED_PERTURBED_FIELD_NUMBER: _ClassVar[int]
    EVALUATED_DERIVATIVES_FIELD_NUMBER: _ClassVar[int]
    INSTANCE_FIELD_NUMBER: _ClassVar[int]
    IMPACTS_FIELD_NUMBER: _ClassVar[int]
    sequence: int
    advanced: Outputs
    predicted: Outputs
    perturbed: _containers.RepeatedCompositeFieldContainer[Outputs]
    work: Work
    failure: Failure
    samples: _containers.RepeatedCompositeFieldContainer[Outputs]
    derivatives: _containers.RepeatedCompositeFieldContainer[Outputs]
    evaluated: Outputs
    evaluated_perturbed: _containers.RepeatedCompositeFieldContainer[Outputs]
    evaluated_derivatives: _containers.RepeatedCompositeFieldContainer[Outputs]
    instance: int
    impacts: Impacts
    def __init__(self, sequence: _Optional[int] = ..., advanced: _Optional[_Union[Outputs, _Mapping]] = ..., predicted: _Optional[_Union[Outputs, _Mapping]] = ..., perturbed: _Optional[_Iterable[_Union[Outputs, _Mapping]]] = ..., work: _Optional[_Union[Work, _Mapping]] = ..., failure: _Optional[_Union[Failure, _Mapping]] = ..., samples: _Optional[_Iterable[_Union[Outputs, _Mapping]]] = ..., derivatives: _Optional[_Iterable[_Union[Outputs, _Mapping]]] = ..., evaluated: _Optional[_Union[Outputs, _Mapping]] = ..., evaluated_perturbed: _Optional[_Iterable[_Union[Outputs, _Mapping]]] = ..., evaluated_derivatives: _Optional[_Iterable[_Union[Outputs, _Mapping]]] = ..., instance: _Optional[int] = ..., impacts: _Optional[_Union[Impacts, _Mapping]] = ...) -> None: ...

class Work(_message.Message):
    __slots__ = ("integrations", "steps", "nanoseconds", "derivatives", "contacts")
    INTEGRATIONS_FIELD_NUMBER: _ClassVar[int]
    STEPS_FIELD_NUMBER: _ClassVar[int]
    NANOSECONDS_FIELD_NUMBER: _ClassVar[int]
    DERIVATIVES_FIELD_NUMBER: _ClassVar[int]
    CONTACTS_FIELD_NUMBER: _ClassVar[int]
    integrations: int
    steps: int
    nanoseconds: int
    derivatives: int
    contacts: Contacts
    def __init__(self, integrations: _Optional[int] = ..., steps: _Optional[int] = ..., nanoseconds: _Optional[int] = ..., derivatives: _Optional[int] = ..., contacts: _Optional[_Union[Contacts, _Mapping]] = ...) -> None: ...

class Contacts(_message.Message):
    __slots__ = ("impacts", "first_impact", "impulse", "penetration", "residual", "problems", "robust", "ambiguous", "jams")
    IMPACTS_FIELD_NUMBER: _ClassVar[int]
    FIRST_IMPACT_FIELD_NUMBER: _ClassVar[int]
    IMPULSE_FIELD_NUMBER: _ClassVar[int]
    PENETRATION_FIELD_NUMBER: _ClassVar[int]
    RESIDUAL_FIELD_NUMBER: _ClassVar[int]
    PROBLEMS_FIELD_NUMBER: _ClassVar[int]
    ROBUST_FIELD_NUMBER: _ClassVar[int]
    AMBIGUOUS_FIELD_NUMBER: _ClassVar[int]
    JAMS_FIELD_NUMBER: _ClassVar[int]
    impacts: int
    first_impact: float
    impulse: float
    penetration: float
    residual: float
    problems: int
    robust: int
    ambiguous: int
    jams: int
    def __init__(self, impacts: _Optional[int] = ..., first_impact: _Optional[float] = ..., impulse: _Optional[float] = ..., penetration: _Optional[float] = ..., residual: _Optional[float] = ..., problems: _Optional[int] = ..., robust: _Optional[int] = ..., ambiguous: _Optional[int] = ..., jams: _Optional[int] = ...) -> None: ...

class Failure(_message.Message):
    __slots__ = ("severity", "message", "field", "variable", "t", "step")
    SEVERITY_FIELD_NUMBER: _ClassVar[int]
    MESSAGE_FIELD_NUMBER: _ClassVar[int]
    FIELD_FIELD_NUMBER: _ClassVar[int]
    VARIABLE_FIELD_NUMBER: _ClassVar[int]
    T_FIELD_NUMBER: _ClassVar[int]
    STEP_FIELD_NUMBER: _ClassVar[int]
    severity: Severity
    message: str
    field: str
    variable: str
    t: float
    step: float
    def __init__(self, severity: _Optional[_Union[Severity, str]] = ..., message: _Optional[str] = ..., field: _Optional[str] = ..., variable: _Optional[str] = ..., t: _Optional[float] = ..., step: _Optional[float] = ...) -> None: ...
