# The part of the module palpate that is written in Python: tables, recordings as objects of pandas
# and xarray, pictures. It is built into the module (CMakeLists.txt) and runs in its name space.

# Positions and directions have components x, y, z; other values one for each matrix, axis, ..
_VECTORS = {
    "sphere_mm", "centroid_sphere_mm", "centroid_mm", "normal", "major", "minor", "position_mm"}


def _imported(package, function):
    import importlib
    try:
        return importlib.import_module(package)
    except ImportError:
        raise ImportError(f"{function}() needs {package}, which can't be imported: "
                          f"install python3-{package}") from None


class Table(dict):
    """A table of results: a dict with an array for each column, all of the same length. `units` and
    `meanings` are dicts by column name (a column without a unit isn't in `units`); `notes` lists
    what the table lacks and its reader should know. A notebook shows its first and last rows."""

    units: dict[str, str]
    meanings: dict[str, str]
    notes: list[str]

    def __init__(self, columns: dict = {}, units: dict = {}, meanings: dict = {}, notes: list = []):
        super().__init__(columns)
        self.units, self.meanings, self.notes = dict(units), dict(meanings), list(notes)

    def to_pandas(self):
        """pandas.DataFrame of the table: palpate.to_pandas(table)."""
        return to_pandas(self)

    def to_xarray(self):
        """xarray.Dataset of the table: palpate.to_xarray(table)."""
        return to_xarray(self)

    def _repr_html_(self):
        import html
        try:
            columns, units = _columns_of(self)
        except ValueError:
            return f"<pre>{html.escape(repr(self))}</pre>"
        count = len(next(iter(columns.values()), ()))

        def row(cells, tag="td"):
            inside = "".join(f"<{tag}>{html.escape(str(cell))}</{tag}>" for cell in cells)
            return f"<tr>{inside}</tr>"

        def rows(places):
            for at in places:
                cells = (values[at] for values in columns.values())
                yield row([at] + [f"{one:.6g}" if isinstance(one, float) else one for one in cells])

        heads = (columns, (units.get(name, "") for name in columns))
        lines = [row(["", *head], "th") for head in heads]
        ends = 5
        lines += rows(range(count if count <= 2 * ends else ends))
        if count > 2 * ends:
            lines += [row(["\u2026"] * (len(columns) + 1)), *rows(range(count - ends, count))]
        below = [f"{count} {'row' if count == 1 else 'rows'}", *self.notes]
        texts = "".join(f"<p>{html.escape(line)}</p>" for line in below)
        return f"<table>{''.join(lines)}</table>{texts}"


def flat(table: dict) -> Table:
    """The table with one column for each number of a row, as pandas.DataFrame takes it: an array
    (T,) stays as it is, (T, M) becomes NAME_0 .. NAME_(M-1) (matrices, axes), positions and
    directions become NAME_x, NAME_y, NAME_z, or NAME_0_x .. for (T, M, 3). ValueError for what
    isn't a table: a report, or arrays of different lengths."""
    import numpy
    columns, units, meanings, rows = {}, {}, {}, None
    for name, value in table.items():
        try:
            array = numpy.asarray(value)
        except ValueError:
            array = numpy.asarray(None)
        if array.ndim == 0:
            raise ValueError(f"'{name}' isn't an array: a report isn't a table")
        if rows is not None and len(array) != rows:
            raise ValueError(f"'{name}' has {len(array)} rows, those before it {rows}")
        if array.ndim > 3:
            raise ValueError(f"'{name}' has more than 3 dimensions")
        rows = len(array)
        for place in numpy.ndindex(array.shape[1:]):
            parts = [str(part) for part in place]
            if parts and name in _VECTORS and place[-1] < 3:
                parts[-1] = "xyz"[place[-1]]
            column = "_".join([str(name), *parts])
            columns[column] = array[(slice(None), *place)]
            for of, known in ((units, "units"), (meanings, "meanings")):
                if name in getattr(table, known, {}):
                    of[column] = getattr(table, known)[name]
    return Table(columns, units, meanings, getattr(table, "notes", ()))


def _columns_of(table):
    """The columns of flat(), and those with a list per row (fingers of grasps); and the units."""
    import numpy
    arrays = {name: value for name, value in table.items() if isinstance(value, numpy.ndarray)}
    columns = flat(Table(arrays, getattr(table, "units", {})))
    rows = len(next(iter(columns.values()), ()))
    for name, value in table.items():
        if name in arrays:
            continue
        if not isinstance(value, list) or len(value) != rows:
            raise ValueError(f"'{name}' isn't an array: a report isn't a table")
        columns[name] = value
    return columns, columns.units


def _times_of(table):
    """The column that says when a row is, as datetime64; None without one."""
    for name in ("time_ms", "begin_ms"):
        if name in table:
            return _instants(table[name].astype("int64") * 1000)
    return None


def _instants(time_us):
    return time_us.astype("datetime64[us]")


def _in_unit(unit, of):
    return unit if of == "counts" else of


def to_pandas(table: dict, *, unit: str = "counts"):
    """pandas.DataFrame of a table (signals(), slip(), contact(), grasps(), ..): the columns of
    flat(), indexed by host time (datetime64, UTC) where the table has time_ms or begin_ms.
    attrs['units']: column -> unit, as the Table says (a plain dict has none); `unit` replaces
    counts. ImportError without pandas, ValueError for what isn't a table."""
    pandas = _imported("pandas", "to_pandas")
    columns, units = _columns_of(table)
    frame = pandas.DataFrame(dict(columns))
    times = _times_of(table)
    if times is not None:
        frame.index = pandas.DatetimeIndex(times, name="time")
    frame.attrs["units"] = {name: _in_unit(unit, of) for name, of in units.items()}
    return frame


def to_xarray(table: dict, *, unit: str = "counts"):
    """xarray.Dataset of a table: dims time (host time as datetime64, UTC; `row` where the table has
    no time), matrix, and axis (x, y, z) of positions and directions; the attribute units of each
    variable, as the Table says (a plain dict has none), where `unit` replaces counts. Lists of
    different lengths, such as fingers of grasps(), are left out. ImportError without xarray,
    ValueError for what isn't a table."""
    import numpy
    xarray = _imported("xarray", "to_xarray")
    arrays = {name: value for name, value in table.items() if isinstance(value, numpy.ndarray)}
    flat(arrays)  # raises for what isn't a table
    times = _times_of(arrays)
    row = "row" if times is None else "time"
    variables, coordinates = {}, {}
    for name, array in arrays.items():
        vector = name in _VECTORS and array.ndim > 1 and array.shape[-1] == 3
        dims = [row]
        if array.ndim - vector > 1:
            dims.append("matrix")
        if vector:
            dims.append("axis")
            coordinates["axis"] = ["x", "y", "z"]
        if len(dims) != array.ndim:
            raise ValueError(f"'{name}' has {array.ndim} dimensions, a table has up to 3")
        of = getattr(table, "units", {}).get(name)
        variables[name] = (dims, array, {"units": _in_unit(unit, of)} if of else {})
    if times is not None:
        coordinates["time"] = (row, times)
    return xarray.Dataset(variables, coordinates)


def _program():
    """The program palpate next to the module: in its build folder or its installation only."""
    from pathlib import Path
    folder = Path(__file__).resolve().parent
    places = [folder.parent / "palpate", *(up / "bin" / "palpate" for up in folder.parents[2:3])]
    for place in places:
        if place.is_file():
            return str(place)
    missing = " or ".join(map(str, places))
    raise Error(f"render() needs the program palpate, which isn't at {missing}: "
                "build or install it")


def render(path, out, **options) -> None:
    """Draws a recording by running `palpate render`: one frame (.png, .svg, .pdf), a
    movie (.mp4), or with from_ and to a folder of pictures. path: a recording, or a list of them
    with a template as out ('out/{name}.png'). The options are those of the command with _ for -:
    frame=7, view='hand', width_mm=85, range=(0, 500), values=True, filter=['median'], from_=10,
    to=20, force=True. ValueError for a wrong option, else Error."""
    import os
    import subprocess
    paths = [path] if isinstance(path, (str, bytes, os.PathLike)) else list(path)
    words = [_program(), "render", *(os.path.abspath(os.fsdecode(one)) for one in paths)]
    for name, value in {"output": os.fspath(out), "quiet": True, **options}.items():
        option = "--" + name.strip("_").replace("_", "-")
        if isinstance(value, tuple):
            value = ",".join(map(str, value))
        for one in value if isinstance(value, list) else [value]:
            if one is True:
                words.append(option)
            elif one is not None and one is not False:
                words.append(f"{option}={one}")
    done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          errors="replace")
    if done.returncode != 0:
        said = done.stderr.strip() or f"palpate render ended with code {done.returncode}"
        text = said.splitlines()[-1].removeprefix("palpate: ").replace("--force", "force=True")
        raise (ValueError if done.returncode == 2 else Error)(text)


def _add_to_profile():
    def attributes_of(profile, units):
        return {"units": units, "hand": profile.hand, "serial": profile.serial}

    def to_pandas(self):
        """pandas.DataFrame of the taxels that exist: a row per frame, indexed by its host time
        (datetime64, UTC), a column per taxel, named by matrix, y and x; attrs: units, hand, serial.
        ImportError without pandas."""
        import numpy
        pandas = _imported("pandas", "to_pandas")
        masks = [matrix["static_mask"] for matrix in self.matrices]
        names = [(matrix["name"], int(y), int(x))
                 for matrix, mask in zip(self.matrices, masks) for y, x in numpy.argwhere(mask)]
        frame = pandas.DataFrame(
            self.frames()[:, numpy.concatenate([mask.ravel() for mask in masks])],
            index=pandas.DatetimeIndex(_instants(self.time_us), name="time"),
            columns=pandas.MultiIndex.from_tuples(names, names=["matrix", "y", "x"]))
        frame.attrs.update(attributes_of(self, self.unit))
        return frame

    def array_of_matrix(xarray, profile, matrix):
        import numpy
        pitch = matrix["pitch_mm"]
        pitch_x, pitch_y = pitch if isinstance(pitch, list) else (pitch, pitch)
        places = {name: (name, numpy.arange(matrix[count]) * pitch, {"units": "mm"})
                  for name, count, pitch in (("y", "rows", pitch_y), ("x", "columns", pitch_x))}
        values = numpy.where(matrix["static_mask"], profile.matrix(matrix["index"]), numpy.nan)
        return xarray.DataArray(
            values.astype("float32"), coords={"time": _instants(profile.time_us), **places},
            dims=["time", "y", "x"], name=matrix["name"],
            attrs=attributes_of(profile, profile.unit))

    def array_of_series(xarray, profile, name, dim, names, unit):
        series = profile.series[name]
        coordinates = {"time": _instants(series.times_us // 1000 * 1000)}
        if len(names) == series.values.shape[1]:
            coordinates[dim] = names
        return xarray.DataArray(series.values, coords=coordinates, dims=["time", dim], name=name,
                                attrs=attributes_of(profile, unit))

    def to_xarray(self, matrix: int | None = None):
        """xarray.DataArray of one matrix: dims time (datetime64, UTC), y and x [mm from taxel (0,
        0)]; NaN where there is no taxel. Without `matrix` a dict of them by the names of the
        matrices, with 'angles' (time, axis) and 'temperatures' (time, sensor) where the recording
        has them. attrs: units, hand, serial. ImportError without xarray."""
        xarray = _imported("xarray", "to_xarray")
        matrices = self.matrices
        if matrix is not None:
            if not 0 <= matrix < len(matrices):
                raise IndexError(f"matrix {matrix} is not in 0..{len(matrices) - 1}")
            return array_of_matrix(xarray, self, matrices[matrix])
        found = {one["name"]: array_of_matrix(xarray, self, one) for one in matrices}
        units = self.series["angles"].units
        angle_unit = ", ".join(units if len(set(units)) > 1 else units[:1]) or "deg"
        for name, dim, names, unit in (
                ("angles", "axis", self.axes, angle_unit),
                ("temperatures", "sensor", self.temperature_sensors, "deg C")):
            if len(self.series[name]) > 0:
                found[name] = array_of_series(xarray, self, name, dim, names, unit)
        return found

    for method in (to_pandas, to_xarray):
        method.__qualname__ = f"Profile.{method.__name__}"
        setattr(Profile, method.__name__, method)


def _add_one_line_errors():
    """Makes the error of a function for wrong arguments one line, as all errors are."""
    def one_line(function, name, is_method=False):
        def call(*args, **kwargs):
            try:
                return function(*args, **kwargs)
            except TypeError as error:
                if "\n" not in str(error):
                    raise
            given = [type(value).__name__ for value in args[is_method:]]
            given += [f"{key}={type(value).__name__}" for key, value in kwargs.items()]
            of = name.removesuffix(".__init__")
            raise TypeError(f"{of}() doesn't take ({', '.join(given)}): see help(palpate.{of})")
        call.__name__, call.__qualname__ = name.rpartition(".")[2], name
        call.__doc__, call.__module__ = function.__doc__, __name__
        return call

    for name, thing in list(globals().items()):
        if name.startswith("_"):
            continue
        if type(thing).__name__ == "builtin_function_or_method":
            globals()[name] = one_line(thing, name)
        for member, kind in list(vars(thing).items()) if isinstance(thing, type) else ():
            if member.startswith("_") and member not in ("__init__", "__getitem__"):
                continue
            whole = f"{name}.{member}"
            if isinstance(kind, staticmethod):
                setattr(thing, member, staticmethod(one_line(getattr(thing, member), whole)))
            elif type(kind).__name__ == "instancemethod":
                setattr(thing, member, one_line(getattr(thing, member), whole, is_method=True))


_add_to_profile()
_add_one_line_errors()
