"""The Python reader printed in docs/notes/palpate_format.md runs and gives the values."""
import os
import re
import sqlite3
import unittest
from pathlib import Path

import independent_reader

SOURCE = Path(os.environ["PALPATE_SOURCE"])
WHOLE = Path(os.environ["PALPATE_CORPUS"]) / "palpate" / "whole.palpate"


class FormatDocument(unittest.TestCase):
    def test_its_reader_reads(self):
        text = (SOURCE / "docs/notes/palpate_format.md").read_text()
        (code,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        self.assertLessEqual(len(code.strip().splitlines()), 15)
        names = {}
        exec(code, names)
        frames, angles, _ = independent_reader.read(WHOLE)
        read = list(names["items"](WHOLE, 0, 486))
        self.assertEqual(read, [(t, values) for t, _, values in frames])
        read = list(names["items"](WHOLE, 1, 7))
        self.assertEqual(read, [(t, values) for t, _, values in angles])

    def test_its_tables_are_those_of_the_file(self):
        text = (SOURCE / "docs/notes/palpate_format.md").read_text()
        (code,) = re.findall(r"```sql\n(.*?)```", text, re.DOTALL)
        code = "\n".join(line for line in code.splitlines() if not line.startswith("--"))
        plain = lambda sql: re.sub(r"\s+", "", sql).lower()
        told = {plain(sql) for sql in code.split(";") if sql.strip()}
        rows = sqlite3.connect(WHOLE).execute("SELECT sql FROM sqlite_master WHERE sql IS NOT NULL")
        self.assertEqual(told, {plain(sql) for (sql,) in rows})

    def test_its_keys_of_meta_are_those_of_the_file(self):
        text = (SOURCE / "docs/notes/palpate_format.md").read_text()
        told = set(re.findall(r"`(\w+)`", text.split("## Meta")[1].split("## ")[0]))
        for (key,) in sqlite3.connect(WHOLE).execute("SELECT key FROM meta"):
            self.assertIn(key, told)


if __name__ == "__main__":
    unittest.main()
