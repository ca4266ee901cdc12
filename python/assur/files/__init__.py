"""Files of mechanisms and machines: TOML, with the words of the Python interface.

`Mechanism.save` and `Machine.save` write them, `assur.load` reads them; docs/reference/files.md
describes the format. `read` also gives the results that a file asks for.
"""

from pathlib import Path

from assur.files.contents import Contents, load, read
from assur.files.errors import FileError
from assur.files.ranges import Range
from assur.files.write import save

__all__ = ["SCHEMA", "Contents", "FileError", "Range", "load", "read", "save"]

#: The JSON schema of the format, for editors.
SCHEMA = Path(__file__).with_name("schema.json")
