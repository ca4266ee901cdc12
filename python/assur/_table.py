"""Tables of results: named columns with units, as a DataFrame, a workbook or a Parquet file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import flag, short
from assur._other_names import other_names
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from os import PathLike

    import numpy.typing as npt
    import pandas as pd
    import xarray as xr

__all__ = [
    "Column",
    "Tabular",
    "angle_column",
    "coordinate_columns",
    "design_columns",
    "frame",
    "write_excel",
    "write_parquet",
]

# Excel's own limits.
MAX_ROWS = 1_048_576
MAX_SHEET_NAME = 31
# Numbers written to a Parquet file at once, some hundredths of a second; and rows.
NUMBERS_AT_ONCE = 1 << 20
LEAST_ROWS = 1024


class Column(NamedTuple):
    """A column: `quantity` is what it belongs to, None for those that say which row it is."""

    name: str
    values: npt.NDArray[Any]
    unit: str
    quantity: str | None


def frame(columns: Iterable[Column]) -> pd.DataFrame:
    """Return a pandas DataFrame; its ``attrs["units"]`` maps columns to units."""
    try:
        import pandas as pd
    except ImportError as error:  # pragma: no cover
        message = "to_dataframe needs pandas: pip install assur[dataframe]"
        raise ImportError(message) from error
    listed = list(columns)
    table = pd.DataFrame({column.name: column.values for column in listed})
    table.attrs["units"] = {column.name: column.unit for column in listed if column.unit}
    return table


def write_excel(path: str | PathLike[str], columns: Iterable[Column]) -> None:
    """Write a workbook: a sheet for each quantity, units in the second row."""
    try:
        from openpyxl import Workbook
    except ImportError as error:  # pragma: no cover
        message = "to_excel needs openpyxl: pip install assur[excel]"
        raise ImportError(message) from error
    # `import assur` does without files.
    from assur._files import checked_path, writing

    out = checked_path(path)
    listed = list(columns)
    rows = max((len(column.values) for column in listed), default=0)
    if rows + 2 > MAX_ROWS:
        message = f"to_excel: {rows} rows; a sheet holds {MAX_ROWS - 2}: use to_parquet"
        raise InputError(message)
    # Opened first: what cannot be written is refused before sheets are made.
    with writing(out), out.open("wb") as file:
        _workbook(Workbook(write_only=True), listed).save(file)


def _workbook(book: Any, listed: list[Column]) -> Any:
    """Fill a workbook."""
    common = [column for column in listed if column.quantity is None]
    names: set[str] = set()
    quantities = dict.fromkeys(column.quantity for column in listed if column.quantity is not None)
    for quantity in quantities or {"table": None}:
        of_quantity = [column for column in listed if column.quantity == quantity]
        sheet = book.create_sheet(_sheet_name(quantity, names))
        sheet.freeze_panes = "A3"
        shown = [*common, *of_quantity]
        for texts in ([column.name for column in shown], [column.unit for column in shown]):
            sheet.append([_text(sheet, text) for text in texts])
        for row in zip(*(column.values.tolist() for column in shown), strict=True):
            sheet.append([_cell(value) for value in row])
    return book


def write_parquet(path: str | PathLike[str], columns: Iterable[Column]) -> None:
    """Write one table; the units are in its metadata."""
    from importlib.util import find_spec

    from assur._files import checked_path, writing

    if find_spec("pyarrow") is None:  # pragma: no cover
        message = "to_parquet needs pyarrow: pip install assur[parquet]"
        raise ImportError(message)
    out = checked_path(path)
    table = frame(columns)
    with writing(out), out.open("wb") as file:
        try:
            _in_parts(file, table)
        except BaseException:
            # What is written so far would be read as a whole table.
            file.truncate(0)
            raise


def _in_parts(file: Any, table: Any) -> None:
    """Write a DataFrame as pandas does, but in parts: between two of them signals are heard."""
    import json
    from importlib import import_module

    pa: Any = import_module("pyarrow")
    parquet: Any = import_module("pyarrow.parquet")
    schema = pa.Schema.from_pandas(table, preserve_index=False)
    # Where pandas reads `attrs` from.
    attributes = {"PANDAS_ATTRS": json.dumps(table.attrs)} if table.attrs else {}
    schema = schema.with_metadata({**(schema.metadata or {}), **attributes})
    # Results hardly repeat: a dictionary of them takes more time and space than they do.
    repeating = [name for name in table if table[name].dtype.kind != "f"]
    rows = max(LEAST_ROWS, NUMBERS_AT_ONCE // max(1, table.shape[1]))
    with parquet.ParquetWriter(
        file, schema, compression="snappy", use_dictionary=repeating
    ) as writer:
        for row in range(0, len(table), rows):
            part = table.iloc[row : row + rows]
            writer.write_batch(pa.RecordBatch.from_pandas(part, schema, preserve_index=False))


def _sheet_name(quantity: str, names: set[str]) -> str:
    """Return a name that Excel takes and no other sheet has."""
    plain = "".join("_" if letter in r"[]:*?/\\" else letter for letter in quantity)
    name, count = plain[:MAX_SHEET_NAME].strip("'") or "_", 1
    while name.lower() in names:
        count += 1
        tail = f"~{count}"
        name = plain[: MAX_SHEET_NAME - len(tail)] + tail
    # Excel keeps this name for itself.
    name = "History~" if name.lower() == "history" else name
    names.add(name.lower())
    return name


def _text(sheet: Any, text: str) -> Any:
    """Return a cell that Excel takes for text: a name may begin like a formula."""
    from openpyxl.cell import WriteOnlyCell

    cell = WriteOnlyCell(sheet, text)
    cell.data_type = "s"
    return cell


def _cell(value: Any) -> Any:
    """Excel has no NaN and no infinity: an empty cell, and words."""
    if isinstance(value, float) and not np.isfinite(value):
        return None if np.isnan(value) else f"{value}"
    return value if isinstance(value, int | float | str | bool | None) else short(value)


@other_names(to_csv="to_dataframe().to_csv(path)")
class Tabular:
    """What can be shown as a table: `_columns` returns its columns."""

    def _columns(self, degrees: bool) -> Sequence[Column]:
        raise NotImplementedError

    def to_dataframe(self, *, degrees: bool = False) -> pd.DataFrame:
        """Return a pandas DataFrame (needs pandas); its ``attrs["units"]`` has the units.

        Parameters
        ----------
        degrees : bool
            Angles in degrees; speeds remain rad/s.

        Returns
        -------
        pandas.DataFrame
            A row for each position, time or event of the result.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> table = machine.reactions([0.0, 1.0], speed=10.0).to_dataframe(degrees=True)
        >>> len(table), table.attrs["units"]["q"]
        (2, 'deg')
        >>> list(table)[:6]
        ['q', 'status', 'driver', 'O.x on crank', 'O.y on crank', 'A.x on rod']
        """
        return frame(self._columns(flag(degrees, "degrees")))

    def to_excel(self, path: str | PathLike[str], *, degrees: bool = False) -> None:
        """Write a workbook, a sheet for each quantity, units in the second row (needs openpyxl).

        Parameters
        ----------
        path : path-like
            The file.
        degrees : bool
            As for `to_dataframe`.

        Examples
        --------
        >>> import assur, pathlib, tempfile
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> found = machine.reactions([0.0, 1.0], speed=10.0)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     found.to_excel(pathlib.Path(folder, "forces.xlsx"), degrees=True)
        """
        write_excel(path, self._columns(flag(degrees, "degrees")))

    def to_parquet(self, path: str | PathLike[str], *, degrees: bool = False) -> None:
        """Write `to_dataframe` as a Parquet file (needs pandas and pyarrow).

        Parameters
        ----------
        path : path-like
            The file.
        degrees : bool
            As for `to_dataframe`.

        Examples
        --------
        >>> import assur, pathlib, tempfile
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> found = machine.reactions([0.0, 1.0], speed=10.0)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     found.to_parquet(pathlib.Path(folder, "forces.parquet"))
        """
        write_parquet(path, self._columns(flag(degrees, "degrees")))

    def to_xarray(self, *, degrees: bool = False) -> xr.Dataset:
        """Return `to_dataframe` as an xarray Dataset over its rows (needs xarray), with units.

        Parameters
        ----------
        degrees : bool
            As for `to_dataframe`.

        Returns
        -------
        xarray.Dataset
            Over the dimension row.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> data = machine.reactions([0.0, 1.0], speed=10.0).to_xarray()
        >>> dict(data.sizes), data["driver"].attrs["units"]
        ({'row': 2}, 'N m')
        """
        try:
            import xarray as xr
        except ImportError as error:  # pragma: no cover
            message = "to_xarray needs xarray: pip install assur[xarray]"
            raise ImportError(message) from error
        columns = self._columns(flag(degrees, "degrees"))
        return xr.Dataset(
            {
                column.name: ("row", column.values, {"units": column.unit})
                for column in columns
                if column.quantity
            },
            {
                column.name: ("row", column.values, {"units": column.unit})
                for column in columns
                if not column.quantity
            },
        )


def angle_column(name: str, values: npt.NDArray[Any], degrees: bool) -> Column:
    """Return a column of angles that says which row it is, rad or deg."""
    shown, unit = (in_degrees(values), "deg") if degrees else (values, "rad")
    return Column(name, shown, unit, None)


def in_degrees(angles: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return angles in degrees: the few digits that someone typed, where they give these bits."""
    degrees = np.degrees(angles)
    typed = np.round(degrees, 9)
    shown: npt.NDArray[Any] = np.where(typed * (np.pi / 180.0) == angles, typed, degrees)
    return shown


def design_columns(
    shape: tuple[int, ...], designs: int, kept: npt.NDArray[np.intp] | None = None
) -> list[Column]:
    """Return the indices of designs, the first axes of a shape, for each row.

    Designs that a sweep has `kept` have the indices that they had among all.
    """
    columns = []
    for axis in range(designs):
        name = "design" if designs == 1 else f"design{axis}"
        designs_of_axis = np.arange(shape[axis]) if kept is None else kept
        index = designs_of_axis.reshape((-1,) + (1,) * (len(shape) - axis - 1))
        columns.append(Column(name, np.broadcast_to(index, shape).reshape(-1), "", None))
    return columns


def coordinate_columns(
    q: npt.NDArray[Any], angles: Sequence[bool], shape: tuple[int, ...], degrees: bool
) -> list[Column]:
    """Return coordinates for each row; with several drivers q has a last axis."""
    columns = []
    for k, is_angle in enumerate(angles):
        name = "q" if len(angles) == 1 else f"q{k}"
        coordinates = q if len(angles) == 1 else q[..., k]
        values = np.broadcast_to(coordinates, shape).reshape(-1)
        is_length = Column(name, values, "m", None)
        columns.append(angle_column(name, values, degrees) if is_angle else is_length)
    return columns


def columns_of(shown: Tabular, degrees: bool) -> Sequence[Column]:
    """Return the columns of the table of a result."""
    return shown._columns(degrees)
