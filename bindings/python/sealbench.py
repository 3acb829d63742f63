"""Elastomer seals of inhaler valves: a module over libsealbench.

    import sealbench

    with sealbench.Scene("thesis-cycle.scene") as scene:
        scene["seal.section_diameter"] = "1.63 mm"
        scene.run()
        print(scene.figure("cycle.force_breakaway_N"))
        time, force = scene.frames("time_s", "force_N")

Parameters, figures and quantities go by the keys of the files and of the program's JSON; PARAMETERS,
FIGURES and QUANTITIES describe them. Numbers are SI, texts carry units ("1.63 mm"). Arrays are
numpy's float64 where numpy is installed, else array.array("d"); they are copies. A figure that was
not computed is NaN, and reason() says why. Each scene has a lock: a call from another thread waits until
the one before has ended. Different scenes are used in different threads at the same time, and a run lets
other threads continue. A callback cannot use its own scene (RuntimeError).

A scene is also a mapping of its parameters: `"gland.radial_space" in scene`, list(scene), dict(scene).
copy.copy(), copy.deepcopy() and pickle make a new scene from the text of the old one, without its run;
files that the text names are read again.

The library is looked for by the name in the environment variable SEALBENCH_LIBRARY, beside this
module's own installation, then where the system's loader looks.
"""
from __future__ import annotations

import array
import contextlib
import ctypes
import glob
import math
import numbers
import os
import threading
from collections.abc import Callable, Iterable, Iterator, Mapping
from types import TracebackType
from typing import Any, NamedTuple, Union

try:
    import numpy
except ImportError:
    numpy = None  # type: ignore[assignment]

__all__ = ["Scene", "Error", "Parameter", "Figure", "Profile", "Verdict", "PARAMETERS", "FIGURES", "QUANTITIES",
           "VERSION"]

Value = Union[float, int, str]
Array = Any  # numpy.ndarray or array.array, of doubles


class Parameter(NamedTuple):
    """A row of the catalogue of parameters; SI."""
    key: str
    symbol: str
    unit: str
    shown: str
    choices: tuple[str, ...]
    label: str
    help: str
    low: float
    high: float
    default: float


class Figure(NamedTuple):
    """A figure of a run, or a quantity of its frames, with its SI unit ("1": none)."""
    key: str
    unit: str


class Profile(NamedTuple):
    """Over a seal's contact, by rising x in the seal's frame [m]: total pressure above the lower of
    the two fluid pressures [Pa], film [m], what asperities bear [Pa], and the model that made it."""
    x: Array
    pressure: Array
    film: Array
    asperity_pressure: Array
    model: str


class Verdict(NamedTuple):
    """Answer to one question of the verdict: True, False or None (not known); why; the figure that
    decides, its value and its limit (SI, NaN: none); the case that gives the answer ("": the scene itself)."""
    ok: bool | None
    reason: str
    figure: str
    value: float
    limit: float
    case: str


class Error(Exception):
    """A call that failed: `status` is one of the names below, `key` the parameter at fault or ""."""
    STATUS = ("ok", "input", "range", "infeasible", "not-converged", "cancelled", "memory", "io")

    def __init__(self, status: int, message: str, key: str = "") -> None:
        super().__init__(message)
        self.status = self.STATUS[status]
        self.key = key


# ---- The library ----

_Double = ctypes.c_double
_Text = ctypes.c_char_p
_OnProgress = ctypes.CFUNCTYPE(None, ctypes.c_void_p, _Double)
_IsCancelled = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)


class _ParameterInfo(ctypes.Structure):
    _fields_ = [(name, _Text) for name in ("key", "symbol", "unit", "shown", "choices", "label", "help")]
    _fields_ += [(name, _Double) for name in ("low", "high", "default_value")]


class _FigureInfo(ctypes.Structure):
    _fields_ = [("key", _Text), ("unit", _Text)]


class _Profile(ctypes.Structure):
    _fields_ = [("count", ctypes.c_size_t)]
    _fields_ += [(name, ctypes.POINTER(_Double)) for name in ("x", "pressure", "film", "asperity_pressure")]
    _fields_ += [("model", _Text)]


class _Verdict(ctypes.Structure):
    _fields_ = [("question", _Text), ("ok", ctypes.c_int), ("reason", _Text), ("figure", _Text)]
    _fields_ += [("value", _Double), ("limit", _Double), ("of_case", _Text)]


def _load() -> ctypes.CDLL:
    name = "libsealbench.so.0"
    here = os.path.dirname(os.path.abspath(__file__))
    # lib/python3/dist-packages/ and lib/TRIPLET/ are neighbours.
    beside = [path for up in ("../..", "../../..") for where in ("", "*")
              for path in sorted(glob.glob(os.path.join(here, up, where, name)))]
    own = os.environ.get("SEALBENCH_LIBRARY")
    failure = None
    for path in [own] if own else [*beside, name]:
        try:
            return ctypes.CDLL(path)
        except OSError as error:
            failure = error
    raise ImportError(f"libsealbench is not there: {failure}; SEALBENCH_LIBRARY names it")


_lib = _load()
_scene, _size, _pointer = ctypes.c_void_p, ctypes.c_size_t, ctypes.POINTER
for _name, _result, _arguments in (
        ("sb_library_version", _Text, []),
        ("sb_list_parameters", _pointer(_ParameterInfo), [_pointer(_size)]),
        ("sb_list_figures", _pointer(_FigureInfo), [_pointer(_size)]),
        ("sb_list_quantities", _pointer(_FigureInfo), [_pointer(_size)]),
        ("sb_scene_open", ctypes.c_int, [_pointer(_scene), _Text]),
        ("sb_scene_parse", ctypes.c_int, [_pointer(_scene), _Text, _size, _Text]),
        ("sb_scene_new", ctypes.c_int, [_pointer(_scene)]),
        ("sb_scene_close", None, [_scene]),
        ("sb_scene_path", _Text, [_scene]),
        ("sb_scene_message", _Text, [_scene]),
        ("sb_scene_message_key", _Text, [_scene]),
        ("sb_scene_issue", _Text, [_scene, _size]),
        ("sb_scene_title", _Text, [_scene]),
        ("sb_scene_text", _Text, [_scene]),
        ("sb_scene_set_text", ctypes.c_int, [_scene, _Text, _Text]),
        ("sb_scene_set", ctypes.c_int, [_scene, _Text, _Double]),
        ("sb_scene_unset", ctypes.c_int, [_scene, _Text]),
        ("sb_scene_get", ctypes.c_int, [_scene, _Text, _pointer(_Double)]),
        ("sb_scene_get_text", _Text, [_scene, _Text]),
        ("sb_scene_callbacks", None, [_scene, _OnProgress, _IsCancelled, ctypes.c_void_p]),
        ("sb_scene_run", ctypes.c_int, [_scene]),
        ("sb_scene_judge", ctypes.c_int, [_scene]),
        ("sb_scene_verdict", _pointer(_Verdict), [_scene, _size]),
        ("sb_scene_figure", ctypes.c_int, [_scene, _Text, _pointer(_Double)]),
        ("sb_scene_error", ctypes.c_int, [_scene, _Text, _pointer(_Double)]),
        ("sb_scene_reason", _Text, [_scene, _Text]),
        ("sb_library_source", _Text, []),
        ("sb_scene_warning", _Text, [_scene, _size]),
        ("sb_scene_warning_code", _Text, [_scene, _size]),
        ("sb_scene_evaluation_warning_code", _Text, [_scene, _size]),
        ("sb_scene_frame_count", _size, [_scene]),
        ("sb_scene_frames", ctypes.c_int, [_scene, _Text, _pointer(_Double)]),
        ("sb_scene_profile", ctypes.c_int, [_scene, _size, _Text, _pointer(_Profile)]),
        ("sb_scene_evaluate", ctypes.c_int, [_scene, _pointer(_Text), _pointer(_Double), _size,
                                             _pointer(_Text), _size, _pointer(_Double)]),
        ("sb_scene_evaluation_reason", _Text, [_scene, _Text])):
    _function = getattr(_lib, _name)
    _function.restype, _function.argtypes = _result, _arguments


def _text(value: bytes | None) -> str:
    return "" if value is None else value.decode()


def _name(value: str) -> bytes:
    """A text for the library, which reads it up to a NUL."""
    if not isinstance(value, str):
        raise TypeError(f"a str is needed, not {type(value).__name__}")
    if "\0" in value:
        raise Error(1, f"{value!r} contains a NUL", value.partition("\0")[0])
    return value.encode()


def _number(key: str, value: Any) -> float:
    """A parameter's value for the library."""
    if not isinstance(value, numbers.Real):
        raise TypeError(f"{key}: a number is needed, not {type(value).__name__}")
    return float(value)


def _path(value: str | os.PathLike[str]) -> bytes:
    """A path for the library."""
    path = os.fsencode(value)
    if b"\0" in path:
        raise Error(1, f"the path {os.fsdecode(path)!r} contains a NUL")
    return path


def _copy(pointer: Any, count: int) -> Array:
    """A copy of `count` doubles."""
    values = array.array("d", pointer[:count] if count > 0 else [])
    return values if numpy is None else numpy.frombuffer(values, dtype=float)


def _listed(function: Any) -> Iterable[Any]:
    count = _size()
    rows = function(ctypes.byref(count))
    return (rows[i] for i in range(count.value))


VERSION: str = _text(_lib.sb_library_version())
SOURCE: str = _text(_lib.sb_library_source())  # hash of the engine's sources
PARAMETERS: dict[str, Parameter] = {
    _text(row.key): Parameter(
        _text(row.key), _text(row.symbol), _text(row.unit), _text(row.shown),
        tuple(_text(row.choices).split("|")) if row.choices else (), _text(row.label), _text(row.help),
        row.low, row.high, row.default_value)
    for row in _listed(_lib.sb_list_parameters)}
FIGURES: dict[str, Figure] = {
    _text(row.key): Figure(_text(row.key), _text(row.unit)) for row in _listed(_lib.sb_list_figures)}
QUANTITIES: dict[str, Figure] = {
    _text(row.key): Figure(_text(row.key), _text(row.unit)) for row in _listed(_lib.sb_list_quantities)}


class Scene:
    """A valve or scene file in memory, its changes, and what was computed last."""

    def __init__(self, path: str | os.PathLike[str] | None = None, *, text: str | None = None,
                 folder: str | os.PathLike[str] | None = None) -> None:
        """Opens a file or a shipped scene or valve by its name ("quick-look"), or a file's text (other
        files are looked for in `folder`); without either the thesis' valve. Error with every issue of the file, a line each."""
        self._scene: ctypes.c_void_p | None = None
        self._lock = threading.RLock()
        self._inside = False  # a call of the library is under way
        self._calls: tuple[Any, ...] = ()
        self._raised: BaseException | None = None
        # Where other files are looked for when the scene is copied.
        self._folder = os.path.abspath(os.fspath(folder) if folder else ".")
        found = _scene()
        out = ctypes.byref(found)
        if text is not None:
            data = text.encode()
            status = _lib.sb_scene_parse(out, data, len(data), _path(folder) if folder else None)
        elif path is not None:
            status = _lib.sb_scene_open(out, _path(path))
            if opened := found and _lib.sb_scene_path(found):
                self._folder = os.path.dirname(os.path.abspath(os.fsdecode(opened)))
        else:
            status = _lib.sb_scene_new(out)
        self._scene = found
        if status != 0:
            issues, key = [], ""
            while self._scene and (line := _lib.sb_scene_issue(self._scene, len(issues))) is not None:
                issues.append(_text(line))
            if self._scene:
                key = _text(_lib.sb_scene_message_key(self._scene))
            self.close()
            raise Error(status, "\n".join(issues) or "no memory", key)

    def close(self) -> None:
        """Frees the scene; it cannot be used afterwards."""
        with self._lock:
            if self._inside:
                raise RuntimeError("a callback cannot close its own scene")
            if self._scene is not None:
                _lib.sb_scene_close(self._scene)
                self._scene = None

    def __enter__(self) -> Scene:
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None,
                 trace: TracebackType | None) -> None:
        self.close()

    def __del__(self) -> None:
        if getattr(self, "_scene", None) is not None:
            self.close()

    @contextlib.contextmanager
    def _use(self) -> Iterator[ctypes.c_void_p]:
        """The scene for calls of the library, which no other thread makes meanwhile."""
        with self._lock:
            if self._scene is None:
                raise ValueError("the scene is closed")
            if self._inside:
                raise RuntimeError("a callback cannot use its own scene")
            self._inside = True
            try:
                yield self._scene
            finally:
                self._inside = False

    def _check(self, scene: ctypes.c_void_p, status: int) -> None:
        raised, self._raised = self._raised, None
        if raised is not None:
            raise raised
        if status != 0:
            raise Error(status, _text(_lib.sb_scene_message(scene)), _text(_lib.sb_scene_message_key(scene)))

    @property
    def title(self) -> str:
        with self._use() as scene:
            return _text(_lib.sb_scene_title(scene))

    def __reduce__(self) -> tuple[Any, ...]:
        """copy.copy(), copy.deepcopy() and pickle: a scene of the same text, without its run."""
        with self._use() as scene:
            return _reopen, (type(self), _text(_lib.sb_scene_text(scene)), self._folder)

    # ---- Parameters ----

    def __getitem__(self, key: str) -> float:
        """Value in force, SI; the index of a choice."""
        value, name = _Double(), _name(key)
        with self._use() as scene:
            self._check(scene, _lib.sb_scene_get(scene, name, ctypes.byref(value)))
        return value.value

    def __setitem__(self, key: str, value: Value) -> None:
        """Sets a parameter from a text with unit ("1.63 mm", "reynolds") or a number in SI."""
        name = _name(key)
        text = _name(value) if isinstance(value, str) else None
        number = _number(key, value) if text is None else math.nan
        with self._use() as scene:
            if text is not None:
                self._check(scene, _lib.sb_scene_set_text(scene, name, text))
            else:
                self._check(scene, _lib.sb_scene_set(scene, name, number))

    def __delitem__(self, key: str) -> None:
        """Takes the scene's own value back: its valve's or the default is in force again."""
        name = _name(key)
        with self._use() as scene:
            self._check(scene, _lib.sb_scene_unset(scene, name))

    def __len__(self) -> int:
        """Number of parameters."""
        return len(PARAMETERS)

    def __contains__(self, key: object) -> bool:
        return key in PARAMETERS

    def __iter__(self) -> Iterator[str]:
        """The keys of all parameters."""
        return iter(PARAMETERS)

    def keys(self) -> list[str]:
        """The keys of all parameters."""
        return list(PARAMETERS)

    def values(self) -> list[float]:
        """The values in force of all parameters, SI."""
        return [self[key] for key in PARAMETERS]

    def items(self) -> list[tuple[str, float]]:
        """Keys and values in force of all parameters, SI."""
        return [(key, self[key]) for key in PARAMETERS]

    def text(self, key: str) -> str:
        """Value in force as text with unit."""
        name = _name(key)
        with self._use() as scene:
            value = _lib.sb_scene_get_text(scene, name)
            self._check(scene, 0 if value is not None else 1)
            return _text(value)

    # ---- A run ----

    def callbacks(self, progress: Callable[[float], None] | None = None,
                  cancelled: Callable[[], bool] | None = None) -> None:
        """`progress` is told the fraction done; a true answer of `cancelled` ends a run or evaluation
        with Error("cancelled"). What either raises ends it too and is raised again."""
        def guarded(function: Callable[..., Any] | None, failed: Any) -> Callable[..., Any]:
            def call(_data: Any, *arguments: Any) -> Any:
                try:
                    return function(*arguments) if function is not None else None
                except BaseException as error:  # pylint: disable=broad-except
                    self._raised = error
                    return failed
            return call
        asked = guarded(cancelled, True)
        on_progress = _OnProgress(guarded(progress, None))
        is_cancelled = _IsCancelled(lambda data: int(bool(self._raised is not None or asked(data))))
        with self._use() as scene:
            _lib.sb_scene_callbacks(scene, on_progress, is_cancelled, None)
        self._calls = (on_progress, is_cancelled)  # as long as the library may call them

    def run(self) -> None:
        """Computes the scene's cycle. After Error "not-converged", "infeasible" or "cancelled" what was
        finished can be read."""
        with self._use() as scene:
            self._check(scene, _lib.sb_scene_run(scene))

    def figure(self, path: str) -> float:
        """A figure of the last run, SI; NaN: not computed, see reason()."""
        value, name = _Double(), _name(path)
        with self._use() as scene:
            self._check(scene, _lib.sb_scene_figure(scene, name, ctypes.byref(value)))
        return value.value

    def error(self, path: str) -> float:
        """The estimated numerical error of that figure, relative to its magnitude; 0 for inputs and closed
        forms, NaN where it is not known."""
        value, name = _Double(), _name(path)
        with self._use() as scene:
            self._check(scene, _lib.sb_scene_error(scene, name, ctypes.byref(value)))
        return value.value

    def figures(self) -> dict[str, float]:
        """All figures of the last run."""
        return {path: self.figure(path) for path in FIGURES}

    def reason(self, path: str) -> str:
        """Why a figure of the last run is NaN; empty where it is a number."""
        name = _name(path)
        with self._use() as scene:
            return _text(_lib.sb_scene_reason(scene, name))

    @property
    def warnings(self) -> list[str]:
        """Warnings of the last run, a sentence each."""
        found: list[str] = []
        with self._use() as scene:
            while (text := _lib.sb_scene_warning(scene, len(found))) is not None:
                found.append(_text(text))
        return found

    @property
    def warning_codes(self) -> list[str]:
        """Codes of the warnings of the last run, in their order, each once."""
        with self._use() as scene:
            return self._codes(scene, _lib.sb_scene_warning_code)

    @staticmethod
    def _codes(scene: ctypes.c_void_p, code_at: Any) -> list[str]:
        found: dict[str, None] = {}
        index = 0
        while (code := code_at(scene, index)) is not None:
            found[_text(code)] = None
            index += 1
        return list(found)

    @property
    def frame_count(self) -> int:
        """Number of frames of the last run; 0 before it."""
        with self._use() as scene:
            return int(_lib.sb_scene_frame_count(scene))

    def frames(self, *quantities: str) -> list[Array]:
        """An array over the frames of the last run for each quantity."""
        names = [_name(quantity) for quantity in quantities]
        out = []
        with self._use() as scene:
            count = int(_lib.sb_scene_frame_count(scene))
            for name in names:
                values = (_Double * max(count, 1))()
                self._check(scene, _lib.sb_scene_frames(scene, name, values))
                out.append(_copy(values, count))
        return out

    def profile(self, frame: int, seal: str = "outer") -> Profile:
        """Pressure and film over a seal's contact at a frame; empty arrays without contact."""
        got, name = _Profile(), _name(seal)
        with self._use() as scene:
            frame = frame + int(_lib.sb_scene_frame_count(scene)) if frame < 0 else frame
            self._check(scene, _lib.sb_scene_profile(scene, frame, name, ctypes.byref(got)))
            return Profile(_copy(got.x, got.count), _copy(got.pressure, got.count),
                           _copy(got.film, got.count), _copy(got.asperity_pressure, got.count),
                           _text(got.model))

    def judge(self) -> dict[str, Verdict]:
        """Computes the scene as run() does, and each of its [cases]; returns `verdict`."""
        with self._use() as scene:
            self._check(scene, _lib.sb_scene_judge(scene))
        return self.verdict

    @property
    def verdict(self) -> dict[str, Verdict]:
        """The worst answers of the last judge() to "seals", "presses", "returns", "doses", "leak" and
        "fits"; empty before it, and after a later run()."""
        out: dict[str, Verdict] = {}
        with self._use() as scene:
            while at := _lib.sb_scene_verdict(scene, len(out)):
                row = at.contents
                out[_text(row.question)] = Verdict(
                    None if row.ok < 0 else row.ok > 0, _text(row.reason), _text(row.figure),
                    row.value, row.limit, _text(row.of_case))
        return out

    # ---- Evaluation ----

    def evaluate(self, figures: str | Iterable[str], overrides: Mapping[str, float] | None = None,
                 reasons: dict[str, str] | None = None,
                 warnings: list[str] | None = None) -> dict[str, float]:
        """Figures with parameters replaced (SI), to the bit those of a run; computes no more than they
        need and leaves the scene and its last run as they are. One figure may be given as a str.
        `reasons` takes why a figure is NaN, `warnings` the codes of validity of the models that the
        figures needed."""
        given = dict(overrides or {})
        wanted = [figures] if isinstance(figures, str) else list(figures)
        keys = (_Text * max(len(given), 1))(*(_name(key) for key in given))
        values = (_Double * max(len(given), 1))(*(_number(key, value) for key, value in given.items()))
        paths = (_Text * max(len(wanted), 1))(*(_name(path) for path in wanted))
        out = (_Double * max(len(wanted), 1))()
        with self._use() as scene:
            self._check(scene, _lib.sb_scene_evaluate(scene, keys, values, len(given), paths, len(wanted), out))
            for path, value in zip(wanted, out):
                if reasons is not None and math.isnan(value):
                    reasons[path] = _text(_lib.sb_scene_evaluation_reason(scene, _name(path)))
            if warnings is not None:
                warnings.extend(self._codes(scene, _lib.sb_scene_evaluation_warning_code))
        return dict(zip(wanted, out))


def _reopen(kind: type[Scene], text: str, folder: str) -> Scene:
    """A scene of the text of another one, whose files are looked for in the same folder."""
    return kind(text=text, folder=folder)
