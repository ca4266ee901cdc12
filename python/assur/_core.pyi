from collections.abc import Callable, Sequence
from typing import Any, Literal, TypeAlias, final

import numpy as np
import numpy.typing as npt
from typing_extensions import Self

from assur._records import (
    Drawing,
    Ending,
    EventFields,
    FlywheelNumbers,
    GroupFields,
    JammingRunFields,
    RemedyFields,
    SteadyNumbers,
)
from assur.description.words import Drive, Slide
from assur.dynamics.forces.reaction_key import Key
from assur.dynamics.loads.friction import PairFriction
from assur.dynamics.loads.load_values import Function
from assur.dynamics.loads.loads import Body, Load, Table
from assur.dynamics.loads.motors import Motor
from assur.dynamics.machine import Method
from assur.errors import AssurError
from assur.events import AngleLimit, Crossing, Obstacle, Position, Rest, Speed
from assur.fitting.designs import Found as FoundDesign
from assur.fitting.goals import Parts
from assur.fitting.measured import Found as FoundLinkage
from assur.fitting.variables import Variable
from assur.flywheel import Mean, Spline
from assur.flywheel.sizing import Task
from assur.kinematics.assembly import FoundAssemblies
from assur.kinematics.limits import FoundLimits
from assur.kinematics.model import AssemblyNumbers
from assur.kinematics.result_columns import Buffers
from assur.sweeps.terms import Metric

__all__ = [
    "Fit",
    "Flywheels",
    "Inverse",
    "KnownSigns",
    "Machine",
    "Mechanism",
    "PathSearch",
    "Run",
    "Runs",
    "acute",
    "asin",
    "atan2",
    "class_iv_drawing",
    "crank_rocker_blocked",
    "crank_rocker_exact_least_gamma",
    "crank_rocker_extremes",
    "crank_rocker_grashof",
    "crank_rocker_ground_range",
    "crank_rocker_least_gamma",
    "crank_rocker_run",
    "crank_rocker_solve",
    "crank_rocker_turns",
    "curvature",
    "error_kinds",
    "four_bar_drawing",
    "instant_centre",
    "panic_in_chunk",
    "refusal_of_path",
    "refusal_of_poses",
    "remedies",
    "simd_level",
    "sin_cos",
    "slider_crank_deviation",
    "slider_crank_drawing",
    "slider_crank_fourier",
    "slider_crank_fraction",
    "slider_crank_greatest_acceleration",
    "slider_crank_greatest_speed",
    "slider_crank_rod_angle",
    "slider_crank_rod_point",
    "slider_crank_series",
    "slider_crank_stroke",
    "spline_pieces",
    "start_threads_at_once",
    "table_values",
    "unit_angle",
    "version",
]

_Float: TypeAlias = npt.NDArray[np.float64]
# A description: names with places, joints of links, slides, drivers.
_Joints: TypeAlias = list[tuple[str, float, float]]
_Links: TypeAlias = list[tuple[str, list[str]]]
_Slides: TypeAlias = list[tuple[str, Slide]]
_Drivers: TypeAlias = list[str | Drive]
_Signs: TypeAlias = list[tuple[str, int]]
# Dimensions of designs, rows of values, whether each design has its own.
_Rows: TypeAlias = tuple[_Float, _Float, bool]
_Three: TypeAlias = tuple[_Float, _Float, _Float]

@final
class Inverse:
    def __new__(
        cls, original: Mechanism, mechanism: Mechanism, names: list[str], bases: list[str | None]
    ) -> Inverse: ...
    def find(
        self, original: Mechanism, dimensions: _Float, values: list[float]
    ) -> tuple[list[tuple[list[float], list[float], AssemblyNumbers]], list[str], bool]: ...
    def find_rows(
        self, original: Mechanism, rows: _Rows, threads: int | None
    ) -> tuple[_Float, int, npt.NDArray[np.int64], npt.NDArray[np.uint8]]: ...
    def follow(
        self, original: Mechanism, signs: list[int], start: _Float, rows: _Rows, threads: int | None
    ) -> tuple[_Float, npt.NDArray[np.uint8]]: ...

@final
class KnownSigns:
    def __new__(cls, designs: int) -> KnownSigns: ...

@final
class Mechanism:
    def __new__(
        cls, joints: _Joints, links: _Links, slides: _Slides, drivers: _Drivers, assembly: _Signs
    ) -> Self: ...
    @property
    def dimension_names(self) -> list[str]: ...
    @property
    def drawing(self) -> list[float]: ...
    @property
    def q0(self) -> list[float]: ...
    @property
    def assembly(self) -> _Signs: ...
    @property
    def lengths(self) -> list[str]: ...
    @property
    def adjustment(self) -> float: ...
    @property
    def formula(self) -> str: ...
    @property
    def mobility(self) -> tuple[int, int, int]: ...
    @property
    def cls(self) -> int: ...
    @property
    def redundant(self) -> tuple[list[str], list[str]]: ...
    @property
    def groups(self) -> list[GroupFields]: ...
    def dimension(self, name: str) -> int: ...
    def index_of(self, kind: str, name: str) -> int: ...
    def check_coordinate(self, name: str) -> None: ...
    def loaded_link(self, joint: str) -> tuple[str, bool]: ...
    def check_dimensions(self, values: list[float]) -> None: ...
    def solve(
        self,
        dimensions: _Float,
        q: _Float,
        per_design: bool,
        signs: list[int],
        order: int,
        outputs: tuple[list[int], list[int], list[int], list[int]],
        threads: int | None,
        buffers: Buffers | None,
        report: list[int] | None,
        known_signs: KnownSigns | None = None,
    ) -> tuple[list[_Float], npt.NDArray[np.uint8], AssurError | None]: ...
    def sensitivities(
        self,
        dimensions: _Float,
        q: _Float,
        per_design: bool,
        signs: list[int],
        shape: tuple[int, int],
        of: Sequence[tuple[str, int, int]],
        by: list[int],
        threads: int | None,
        *,
        rates: _Float | None = None,
        weights: list[_Float] | None = None,
        total: bool = False,
        of_squares: bool = False,
    ) -> tuple[list[_Float], npt.NDArray[np.uint8]]: ...
    def measure(
        self,
        dimensions: _Float,
        q: _Float,
        signs: list[int],
        metrics: list[Metric],
        conditions: list[tuple[int, str, float]],
        gradients: tuple[list[int], list[int]],
        threads: int | None,
    ) -> tuple[list[_Float], npt.NDArray[np.uint8], npt.NDArray[np.bool_], list[_Float]]: ...
    def places_within(self, q: _Float, over: tuple[float, float]) -> list[int]: ...
    def refusal_of_metric(self, q: _Float, metric: Metric) -> str | None: ...
    def diagnostics(
        self, dimensions: _Float, q: _Float, per_design: bool, signs: list[int]
    ) -> tuple[_Float, _Float]: ...
    def explain(self, dimensions: list[float], q: list[float], signs: list[int]) -> str: ...
    def assemblies(
        self, dimensions: _Float, q: _Float, per_design: bool, threads: int | None
    ) -> list[FoundAssemblies]: ...
    @staticmethod
    def fit(
        joints: _Joints,
        links: _Links,
        slides: _Slides,
        drivers: _Drivers,
        assembly: _Signs,
        *,
        tolerance: tuple[float, float | None],
    ) -> tuple[list[tuple[float, float]], list[float], float]: ...
    @staticmethod
    def for_pose(
        joints: _Joints, links: _Links, slides: _Slides, drivers: _Drivers
    ) -> Mechanism: ...
    def at_pose(
        self, joints: list[tuple[float, float]], angles: list[float], slides: list[float]
    ) -> tuple[list[float], AssemblyNumbers]: ...
    def extremes(
        self,
        dimensions: list[float],
        signs: list[int],
        coordinate: str,
        order: int,
        within: float | None = None,
    ) -> list[tuple[float, float]] | None: ...
    def stretches_beyond(
        self,
        dimensions: list[float],
        signs: list[int],
        coordinate: str,
        order: int,
        level: tuple[float, bool],
    ) -> list[list[float]]: ...
    def limits(self, dimensions: _Float, signs: list[int], threads: int | None) -> FoundLimits: ...
    def drawn_in(
        self, dimensions: list[float], q: list[float], assembly: AssemblyNumbers
    ) -> Self: ...
    @staticmethod
    def statuses() -> list[tuple[str, int]]: ...

# With the feature "test-hooks" alone, which no release has.
def panic_in_chunk(number: int) -> None: ...
def start_threads_at_once(at_once: bool) -> None: ...
def asin(x: _Float) -> _Float: ...
def atan2(y: _Float, x: _Float) -> _Float: ...
def unit_angle(y: _Float, x: _Float) -> _Float: ...
def sin_cos(x: _Float) -> tuple[_Float, _Float]: ...
def refusal_of_path(
    points: _Float, kind: Literal["points", "chamfer", "ordered"], closed: bool | None
) -> str | None: ...
def refusal_of_poses(poses: _Float, length: float | None) -> str | None: ...
def acute(a: _Float, b: _Float) -> _Float: ...
def curvature(d1: _Float, d2: _Float) -> _Float: ...
def instant_centre(
    a: tuple[_Float, _Float, _Float], b: tuple[_Float, _Float, _Float]
) -> _Float: ...
def spline_pieces(knots: _Float, values: _Float, ends: Spline) -> _Float: ...

@final
class Flywheels:
    def __new__(
        cls,
        phi: _Float,
        moment: _Float,
        inertia: _Float,
        spline: Spline,
        task: Task,
        mean: Mean,
        first: _Float,
        second: _Float,
        threads: int | None = None,
        corners: list[int] | None = None,
    ) -> Self: ...
    def numbers(self) -> FlywheelNumbers: ...
    def problem(self, index: int) -> str | None: ...
    def failure(self, index: int, label: str, design: list[int] | None) -> AssurError: ...
    def curve(self, quantity: str, points: _Float) -> _Float: ...

@final
class Fit:
    def __new__(
        cls,
        mechanism: Mechanism,
        base: list[float],
        variables: list[Variable],
        targets: list[Parts],
        conditions: list[tuple[Metric, str, float, float]],
        assemblies: list[list[int]],
        whole_turn: bool,
        seed: int,
        threads: int | None,
    ) -> Self: ...
    def best(self) -> float: ...
    @property
    def evaluations(self) -> int: ...
    def is_settled(self, agreeing: int) -> bool: ...
    def round(self) -> None: ...
    def found(self) -> tuple[list[FoundDesign], FoundDesign | None]: ...

@final
class PathSearch:
    def __new__(
        cls,
        points: _Float,
        is_closed: bool,
        joints: int,
        limits: tuple[float, float, float, float],
        seed: int,
        threads: int | None,
    ) -> Self: ...
    def best(self) -> float: ...
    @property
    def evaluations(self) -> int: ...
    def start(self) -> None: ...
    def round(self, is_apart: bool) -> bool: ...
    def finish(self) -> list[FoundLinkage]: ...

@final
class Run:
    def __new__(cls, state: dict[str, Any]) -> Self: ...
    def __reduce__(self) -> tuple[type[Run], tuple[dict[str, Any]]]: ...
    def arrays(self) -> list[_Float]: ...
    def at(self, points: _Float) -> list[_Float]: ...
    @property
    def events(self) -> list[EventFields]: ...
    @property
    def ending(self) -> Ending: ...
    @property
    def statistics(self) -> dict[str, Any]: ...
    def imbalance(self) -> tuple[float, float, float, float | None]: ...

_Outcomes: TypeAlias = tuple[list[_Float], list[_Float], list[str], npt.NDArray[np.uint8]]

@final
class Runs:
    def __new__(cls, states: list[Run | tuple[int, AssurError]]) -> Self: ...
    def __reduce__(self) -> tuple[type[Runs], tuple[list[Run | tuple[int, AssurError]]]]: ...
    def outcome(self, index: int) -> Run | AssurError: ...
    def outcomes(self, drivers: int) -> _Outcomes: ...
    def at(self, indices: list[int], points: _Float, drivers: int) -> list[_Float]: ...

@final
class Machine:
    def __new__(
        cls,
        mechanism: Mechanism,
        bodies: list[tuple[str, Body]],
        loads: list[Load],
        motors: list[Motor | None],
        friction: list[tuple[str, PairFriction]],
        varied: list[tuple[str, int, str, _Float, str]] = ...,
    ) -> Self: ...
    @staticmethod
    def from_table(
        phi: _Float,
        moment: _Float,
        inertia: _Float,
        spline: Spline,
        periodic: bool,
        motor: Motor | None,
    ) -> Machine: ...
    @property
    def tables(self) -> list[tuple[list[float], bool]]: ...
    @property
    def rows(self) -> list[_Float]: ...
    @property
    def jumps(self) -> list[list[float]]: ...
    @property
    def follows(self) -> tuple[bool, bool]: ...
    def stations(self, dimensions: list[float], start: float, end: float) -> list[float]: ...
    def reversals(self, dimensions: list[float], start: float, end: float) -> list[float]: ...
    def uncovered(
        self, dimensions: list[float], q: list[float]
    ) -> tuple[float, float, float] | None: ...
    @property
    def load_actions(self) -> list[tuple[int, str, str | None, bool]]: ...
    @property
    def functions(self) -> list[Function]: ...
    @property
    def load_functions(self) -> list[Function]: ...
    def reduce(
        self,
        dimensions: _Float,
        q: _Float,
        speed: _Float,
        function_values: _Float,
        sense: list[float],
        threads: int | None,
        report: list[int],
    ) -> tuple[_Float, _Float, _Float, _Float, npt.NDArray[np.uint8], Any]: ...
    def reactions(
        self,
        dimensions: _Float,
        q: _Float,
        per_design: bool,
        speed: _Float,
        acceleration: _Float,
        function_values: _Float,
        reactions: list[Key],
        rows: int,
        squares: bool,
        friction: tuple[list[float], int],
        threads: int | None,
        report: list[int],
    ) -> tuple[list[_Float], npt.NDArray[np.uint8], AssurError | None]: ...
    def equations(
        self,
        dimensions: _Float,
        q: _Float,
        per_design: bool,
        rates: tuple[_Float, _Float, _Float],
        has_motors: bool,
        function_values: _Float,
        terms: list[tuple[str, int]],
        rows: int,
        sense: list[float],
        threads: int | None,
        report: list[int],
        by: list[tuple[str, int]] | None = None,
    ) -> tuple[list[_Float], npt.NDArray[np.uint8], AssurError | None]: ...
    def step(
        self,
        dimensions: _Float,
        state: tuple[_Float, _Float, _Float],
        has_motors: bool,
        rows: int,
        steps: tuple[float, int, tuple[Method, tuple[float, list[float] | None]] | None],
        holds: bool,
        threads: int | None,
    ) -> tuple[list[_Float], npt.NDArray[np.uint8]]: ...
    def equilibria(
        self, dimensions: _Float, ends: list[float], is_turn: bool, intervals: int
    ) -> tuple[
        _Float,
        npt.NDArray[np.bool_],
        _Float,
        _Float,
        list[list[float]],
        list[float],
        bool,
        bool,
        Any,
    ]: ...
    def run(
        self,
        dimensions: list[float],
        along_q: bool,
        start: tuple[float, list[float], list[float]],
        end: float,
        method: Method,
        tolerances: tuple[float, list[float] | None],
        limits: tuple[float, int, float | None],
        breaks: list[float],
        events: list[Rest | Position | Speed | AngleLimit | Crossing | Obstacle],
    ) -> Run: ...
    def runs(
        self,
        designs: tuple[_Float, int],
        along_q: bool,
        states: tuple[float, _Float, _Float, _Float],
        method: tuple[Method, tuple[float, list[float] | None]],
        limits: tuple[float, int, float | None],
        breaks: list[float],
        events: list[Rest | Position | Speed | AngleLimit | Crossing | Obstacle],
        keeping: tuple[bool, int | None],
    ) -> Runs: ...
    def steady(
        self,
        dimensions: list[float],
        q: float,
        span: float,
        speed: float | None,
        mean: Mean,
        method: Method,
        relative: float,
        limits: tuple[int, float | None],
        breaks: list[float],
        flywheel: float,
        fluctuation: float | None,
    ) -> tuple[Run, SteadyNumbers]: ...

def slider_crank_stroke(phi: _Float, lambda_: _Float) -> _Three: ...
def slider_crank_fraction(phi: _Float, lambda_: _Float, n: int) -> _Three: ...
def slider_crank_rod_angle(phi: _Float, lambda_: _Float) -> _Three: ...
def slider_crank_series(phi: _Float, k: _Float, harmonics: int, terms: int | None) -> _Three: ...
def slider_crank_fourier(k: _Float, harmonics: int, terms: int | None) -> _Float: ...
def slider_crank_rod_point(
    phi: _Float, lambda_: _Float, along: _Float, across: _Float
) -> _Three: ...
def slider_crank_greatest_speed(k: _Float, exact: bool) -> tuple[_Float, _Float]: ...
def slider_crank_greatest_acceleration(k: _Float) -> tuple[_Float, _Float]: ...
def slider_crank_deviation(
    lambda_: _Float, n: int, order: int
) -> tuple[_Float, _Float, _Float, _Float]: ...
def crank_rocker_solve(
    phi1: _Float, lengths: list[_Float], rates: list[_Float], printed: bool
) -> _Float: ...
def crank_rocker_blocked(lengths: list[float], gamma_min: float) -> list[list[float]]: ...
def crank_rocker_grashof(lengths: list[_Float], tolerance: float) -> list[str]: ...
def crank_rocker_turns(lengths: list[_Float]) -> tuple[_Float, npt.NDArray[np.bool_]]: ...
def crank_rocker_ground_range(
    coupler: _Float, rocker: _Float, margins: list[float], gamma_min: _Float
) -> _Float: ...
def crank_rocker_extremes(lengths: list[_Float]) -> _Float: ...
def crank_rocker_exact_least_gamma(
    circles: list[_Float], lengths: list[_Float], is_outer: bool
) -> _Float: ...
def crank_rocker_least_gamma(friction: list[_Float], rocker: _Float) -> _Float: ...
def crank_rocker_run(
    case: dict[str, Any], ground: Callable[[float], float]
) -> JammingRunFields: ...
def table_values(table: Table, points: _Float) -> _Float: ...
def remedies(
    joints: _Joints, links: _Links, slides: _Slides, drivers: _Drivers, assembly: _Signs
) -> list[RemedyFields]: ...
def error_kinds() -> list[tuple[str, list[str]]]: ...
def four_bar_drawing(mode: Literal["open", "crossed"]) -> Drawing: ...
def slider_crank_drawing() -> Drawing: ...
def class_iv_drawing(joints: list[tuple[float, float]]) -> Drawing: ...
def simd_level() -> str: ...
def version() -> str: ...
