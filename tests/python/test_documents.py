"""The Python reader printed in docs/palpate_format.md runs and gives the values."""
import os
import re
import unittest
from pathlib import Path

import independent_reader

SOURCE = Path(os.environ["PALPATE_SOURCE"])
WHOLE = Path(os.environ["PALPATE_CORPUS"]) / "palpate" / "whole.palpate"


class FormatDocument(unittest.TestCase):
    def test_its_reader_reads(self):
        text = (SOURCE / "docs/palpate_format.md").read_text()
        (code,) = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
        self.assertLessEqual(len(code.strip().splitlines()), 15)
        names = {}
        exec(code, names)
        frames, angles, _ = independent_reader.read(WHOLE)
        read = list(names["items"](WHOLE, 0, 486))
        self.assertEqual(read, [(t, values) for t, _, values in frames])
        read = list(names["items"](WHOLE, 1, 7))
        self.assertEqual(read, [(t, values) for t, _, values in angles])


if __name__ == "__main__":
    unittest.main()
