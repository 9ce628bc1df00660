"""Makes the man page and the completions of the built program.

    make_pages.py PROGRAM SCENES_FOLDER CHANGELOG OUT_FOLDER
"""
import email.utils
import pathlib
import re
import sys

from completions import bash, fish, zsh
from man_page import man_page
from program_help import Program


def date_of(changelog):
    """Of its newest entry, as 2026-11-22: the page changes with a release, not with the day."""
    stamp = re.search(r"^ -- .*>  (.*)$", changelog.read_text(encoding="utf-8"), re.M)[1]
    return email.utils.parsedate_to_datetime(stamp).strftime("%Y-%m-%d")


def main():
    program, scenes, changelog, out = map(pathlib.Path, sys.argv[1:])
    read = Program(str(program))
    read.scenes(path.stem for path in scenes.glob("*.json"))
    out.mkdir(parents=True, exist_ok=True)
    pages = {"palpate.1": man_page(read, date_of(changelog)), "palpate.bash": bash(read),
             "_palpate": zsh(read), "palpate.fish": fish(read)}
    for name, text in pages.items():
        (out / name).write_text(text, encoding="utf-8")


try:
    main()
except ValueError as error:
    sys.exit(f"make_pages: {error}")
