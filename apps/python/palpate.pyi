# Types of the module palpate; what everything does stands in its docstrings and in docs/python.md.
import os
from collections.abc import Iterator, Sequence
from typing import Any, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Path = Union[str, "os.PathLike[str]"]
_Table = dict[str, NDArray[Any]]  # columns of the same length
_Report = dict[str, Any]
_Source = Union["Profile", "Features", _Path, Sequence[_Path]]

__version__: str

class Error(RuntimeError): ...

class Profile:
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, frame: int) -> NDArray[np.float32]: ...
    @overload
    def __getitem__(self, frames: slice) -> Profile: ...
    def __iter__(self) -> Iterator[NDArray[np.float32]]: ...
    @property
    def angle_time_ms(self) -> NDArray[np.int64]: ...
    @property
    def angles(self) -> NDArray[np.float64]: ...
    @property
    def axes(self) -> list[str]: ...
    @property
    def firmware(self) -> str: ...
    @property
    def format(self) -> str: ...
    @property
    def hand(self) -> str: ...
    @property
    def matrices(self) -> list[_Report]: ...
    @property
    def serial(self) -> str: ...
    @property
    def temperature_sensors(self) -> list[str]: ...
    @property
    def temperature_time_ms(self) -> NDArray[np.int64]: ...
    @property
    def temperatures(self) -> NDArray[np.float64]: ...
    @property
    def time_ms(self) -> NDArray[np.int64]: ...
    @property
    def time_s(self) -> NDArray[np.float64]: ...
    @property
    def time_us(self) -> NDArray[np.int64]: ...
    @property
    def value_type(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    def angles_at_frames(self) -> NDArray[np.float64]: ...
    def crop(self, begin: int, end: int) -> Profile: ...
    def frame_at(self, time_ms: int) -> int | None: ...
    def frames(self, start: int = 0, stop: int | None = None) -> NDArray[np.float32]: ...
    def matrix(self, m: int, start: int = 0, stop: int | None = None) -> NDArray[np.float32]: ...
    def save(self, path: _Path, *, events: Sequence[_Report] = [], force: bool = False) -> None: ...
    def taxel(
        self,
        m: int,
        x: int,
        y: int,
        start: int = 0,
        stop: int | None = None,
    ) -> NDArray[np.float32]: ...
    def temperatures_at_frames(self) -> NDArray[np.float64]: ...
    def timing(self) -> _Report: ...
    def to_pandas(self) -> Any: ...
    def to_xarray(self, matrix: int | None = None) -> Any: ...

class Features:
    def __len__(self) -> int: ...
    @property
    def begin(self) -> NDArray[np.int64]: ...
    @property
    def classes(self) -> list[str]: ...
    @property
    def end(self) -> NDArray[np.int64]: ...
    @property
    def end_frame(self) -> NDArray[np.int64]: ...
    @property
    def files(self) -> list[str]: ...
    @property
    def initial_frame(self) -> NDArray[np.int64]: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def sensor(self) -> str: ...
    @property
    def set(self) -> str: ...
    @property
    def time_ms(self) -> NDArray[np.int64]: ...
    @property
    def troubles(self) -> list[str]: ...
    @property
    def values(self) -> NDArray[np.float64]: ...

class Hand:
    def __init__(self, name: Hand | _Path) -> None: ...
    @property
    def axes(self) -> list[_Report]: ...
    @property
    def full_scale(self) -> float: ...
    @property
    def has_geometry(self) -> bool: ...
    @property
    def maker(self) -> str: ...
    @property
    def matrices(self) -> list[_Report]: ...
    @property
    def name(self) -> str: ...
    @property
    def pinches(self) -> bool: ...
    @property
    def saturation(self) -> float: ...
    @property
    def temperature_sensors(self) -> list[str]: ...
    @property
    def unit(self) -> str: ...

class Model:
    @property
    def carries_over(self) -> bool: ...
    @property
    def classes(self) -> list[str]: ...
    @property
    def classifier(self) -> str: ...
    @property
    def features(self) -> list[str]: ...
    @property
    def inputs(self) -> list[str]: ...
    @property
    def options(self) -> _Report: ...
    @property
    def session_offset(self) -> _Report: ...
    @property
    def set(self) -> str: ...
    @property
    def validation(self) -> _Report: ...
    def adapt(self, source: _Source) -> Model: ...
    def classify(self, source: _Source, *, session_offset: str | float = "model") -> _Report: ...
    def evaluate(
        self,
        source: _Source,
        *,
        adapt: int = 0,
        session_offset: str | float = "model",
    ) -> _Report: ...
    @staticmethod
    def load(path: _Path) -> Model: ...
    def save(self, path: _Path, *, force: bool = False) -> None: ...

class Calibration:
    @property
    def report(self) -> _Report: ...
    def apply(
        self,
        profile: Profile,
        *,
        sensitivity: float | None = None,
        threshold: float | None = None,
        tare: bool = False,
        drift: bool = True,
    ) -> _Report: ...
    @staticmethod
    def load(path: _Path) -> Calibration: ...
    def pressure_at(self, K: ArrayLike, temperature_c: float | None = None) -> _Report: ...
    def save(self, path: _Path, *, force: bool = False) -> None: ...

def bounding_sphere(points_mm: ArrayLike) -> tuple[NDArray[np.float64], float] | None: ...
def calibrate_noise(profile: Profile, *, bins: int = 20) -> _Report: ...
def calibrate_pressure(
    table: _Path | Sequence[tuple[Any, ...]],
    *,
    matrix: int | None = None,
    choices: str = "default",
    area: float = 0.0,
    sensitivity: float = 1.0,
    threshold: float = 100.0,
) -> Calibration: ...
def calibrate_sensitivity(
    sensitivities: ArrayLike,
    K: ArrayLike,
    *,
    threshold: float = 100.0,
) -> _Report: ...
def calibrate_step(
    profile: Profile,
    matrix: int,
    *,
    signal: str = "filtered_mean",
    loss: str = "squares",
    damping: str = "over",
    above: float = 0.0,
    least: float = 1.0,
) -> _Report: ...
def calibrate_tare(profile: Profile) -> _Report: ...
def chebyshev_invariants(picture: ArrayLike, order: int, *, angle: str = "study") -> _Report: ...
def chebyshev_moments(picture: ArrayLike, order: int) -> NDArray[np.float64]: ...
def chebyshev_picture(moments: ArrayLike, size: int) -> NDArray[np.float64]: ...
def contact(
    profile: Profile,
    *,
    angles_deg: ArrayLike | None = None,
    threshold: float = 0.0,
    fingertip: str = "study",
    start: int = 0,
    stop: int | None = None,
) -> _Report: ...
def contact_moments(values: ArrayLike) -> _Report: ...
def details(path: _Path) -> _Report: ...
def emulate(
    scene: _Path | dict[str, Any] = "ball",
    *,
    duration: float = 12.0,
    grasps: int = 0,
    seed: int = 1,
    interval: float = 0.0315,
    zero_error_deg: Sequence[float] = [],
) -> Profile: ...
def evaluate(
    source: _Source,
    *,
    set: str = "best",
    lda: int | None = None,
    classifier: str | None = None,
    protocol: str = "S",
    splits: int = 10,
    seed: int = 0,
    c: float | None = None,
    shrinkage: float | str | None = None,
) -> _Report: ...
def events(path: _Path) -> list[_Report]: ...
def feature_names(set: str = "best", hand: Hand | _Path | None = None) -> list[str]: ...
def features(source: _Source, set: str = "best") -> Features: ...
def filter(
    profile: Profile,
    *specs: str | Sequence[str],
    recipe: _Path | None = None,
    restarts_ms: Sequence[int] = [],
) -> Profile: ...
def filter_series(
    time_s: ArrayLike,
    values: ArrayLike,
    *specs: str | Sequence[str],
) -> NDArray[np.float64]: ...
def filters() -> list[_Report]: ...
def first_contact(profile: Profile, *, frames: int = 3, taxels: int = 3) -> int | None: ...
def fit_kelvin_voigt(
    time_s: ArrayLike,
    values: ArrayLike,
    *,
    m: float | None = None,
    e: float | None = None,
    eta: float | None = None,
) -> _Report: ...
def fit_pressure(
    K: ArrayLike,
    m: ArrayLike,
    pressure_kpa: ArrayLike,
    temperature_c: ArrayLike,
    *,
    study: bool = False,
) -> _Report: ...
def fit_step(
    t: ArrayLike,
    y: ArrayLike,
    *,
    loss: str = "squares",
    damping: str = "over",
    loss_scale: float = 0.0,
) -> _Report: ...
def from_arrays(
    time_ms: ArrayLike,
    frames: ArrayLike | Sequence[ArrayLike],
    *,
    pitch_mm: float = 3.4,
    angles: ArrayLike | None = None,
    angle_time_ms: ArrayLike | None = None,
    temperatures: ArrayLike | None = None,
    temperature_time_ms: ArrayLike | None = None,
    serial: str = "",
) -> Profile: ...
def ghosts(profile: Profile, *specs: str | Sequence[str], above: float = 0.0) -> _Report: ...
def flat(table: _Table) -> _Table: ...
def to_pandas(table: _Table, *, unit: str = "counts") -> Any: ...
def to_xarray(table: _Table, *, unit: str = "counts") -> Any: ...
def grasps(profile: Profile, *, rule: str = "general") -> _Report: ...
def in_square(
    values: ArrayLike,
    size: int = 14,
    above: int = 0,
    left: int = 4,
) -> NDArray[np.float64]: ...
def info(profile: Profile) -> _Report: ...
def hands() -> dict[str, str]: ...
def kinematics(
    angles_deg: ArrayLike, *, fingertip: str = "study", hand: Hand | _Path | None = None
) -> _Report: ...
def load(path: _Path) -> Profile: ...
def meta(path: _Path) -> dict[str, str]: ...
def noisy_contacts(
    *,
    seed: int = 1,
    frames: int = 3000,
    rate: float = 30.0,
    temperature_c: float = 30.0,
    sensitivity: float = 1.0,
    noise_multiple: float = 3.0,
    below: float = 0.0,
    contacts: bool = True,
) -> _Report: ...
def object_size(
    profile: Profile,
    begin: int,
    end: int,
    *,
    fingertip: str = "effective",
) -> _Report: ...
def picture_error(picture: ArrayLike, approximation: ArrayLike) -> float: ...
def preshape(
    name: str, close: float = 0.0, hand: Hand | _Path | None = None
) -> NDArray[np.float64]: ...
def preshapes(hand: Hand | _Path | None = None) -> dict[str, str]: ...
def read_recipe(path: _Path) -> str: ...
def recipes() -> dict[str, str]: ...
def record(
    frames: ArrayLike | Sequence[ArrayLike],
    hand: Hand | _Path,
    *,
    time_ms: ArrayLike | None = None,
    rate: float | None = None,
    angles: ArrayLike | None = None,
    temperatures: ArrayLike | None = None,
    serial: str = "",
) -> Profile: ...
def recover(path: _Path, out: _Path, *, force: bool = False) -> _Report: ...
def save_noise(noise: _Report, path: _Path, *, force: bool = False) -> None: ...
def save_recipe(
    path: _Path,
    *specs: str | Sequence[str],
    name: str = "",
    force: bool = False,
) -> None: ...
def savitzky_golay(
    window: int,
    order: int = 2,
    derivative: int = 0,
    position: float | None = None,
) -> NDArray[np.float64]: ...
def scenes() -> list[str]: ...
def seconds(path: _Path) -> _Table: ...
def signals(profile: Profile, matrix: int | str | None = None) -> _Table: ...
def slip(
    profile: Profile,
    matrix: int | None = None,
    method: str = "contest",
    *,
    reference: str | int = "first",
    step: float = 0.2,
    limit: float = 1.0,
    rotation: float = 5.0,
) -> _Table: ...
def slip_benchmark(
    *,
    noise: float = 5.0,
    shapes: Sequence[str] = [],
    seed: int = 1,
    trials: int = 8,
) -> _Report: ...
def slip_segments(
    profile: Profile,
    matrix: int | None = None,
    method: str = "contest",
    *,
    reference: str | int = "first",
    step: float = 0.2,
    limit: float = 1.0,
    rotation: float = 5.0,
) -> _Table: ...
def coherence(
    time_s: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    *,
    window: int = 256,
    overlap: int | None = None,
    detrend: str = "mean",
    rate: str = "mean",
) -> _Report: ...
def spectrum(
    time_s: ArrayLike,
    values: ArrayLike,
    *,
    window: int = 32,
    overlap: int | None = None,
    detrend: str = "mean",
    rate: str = "mean",
) -> _Report: ...
def step_response(
    t: ArrayLike,
    K: float,
    m: float = 0.0,
    *,
    T1: float | None = None,
    T2: float | None = None,
    T: float | None = None,
    d: float | None = None,
) -> NDArray[np.float64]: ...
def strongest_taxel(profile: Profile) -> tuple[int, int, int] | None: ...
def study_features(
    profile: Profile,
    begin: int,
    end: int,
    *,
    end_frame: int | None = None,
) -> _Report: ...
def surface_points(
    angles_deg: ArrayLike,
    points: ArrayLike,
    *,
    fingertip: str = "study",
    hand: Hand | _Path | None = None,
) -> _Report: ...
def synthesize(
    *,
    duration: float = 12.0,
    rate: float = 31.7,
    angle_rate: float = 160.0,
    temperature_rate: float = 1.0,
    grasps: int = 3,
    peak: float = 1800.0,
    radius: float = 2.4,
    threshold: float = 100.0,
    noise: float = 0.0,
    seed: int = 1,
) -> tuple[Profile, list[tuple[int, int]]]: ...
def synthetic_contact(
    x: ArrayLike,
    y: ArrayLike,
    angle_deg: ArrayLike,
    *,
    shape: str = "disc",
    peak: float = 1500.0,
    noise: float = 5.0,
    seed: int = 1,
    rows: int = 14,
    columns: int = 6,
) -> NDArray[np.float32]: ...
def train(
    source: _Source,
    *,
    set: str = "best",
    classifier: str | None = None,
    lda: int | None = None,
    c: float | None = None,
    shrinkage: float | str | None = None,
) -> Model: ...
def verify(path: _Path) -> _Report: ...
