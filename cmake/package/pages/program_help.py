"""What `palpate --help` and `palpate COMMAND --help` say, taken apart: commands, options, values.

The man page and the completions are made of this and of nothing else, so that they say what the
program says. A help text of another form than expected is an error: the build fails.
"""
import json
import os
import re
import subprocess
import tempfile

RECORDINGS = ("dsa", "palpate", "h5", "hdf5", "mcap")
# How the positional words of a synopsis complete: file endings, or nothing but folders.
WORDS = {
    "FILE": RECORDINGS, "PATH": RECORDINGS, "IN": RECORDINGS, "A": RECORDINGS, "B": RECORDINGS,
    "OUT": RECORDINGS + ("csv", "npz", "mat"), "DATA": ("csv", "tsv", "txt", "npy", "npz", "h5", "hdf5"),
    "PORT": "port", "FOLDER": (), "OUTFOLDER": (),
}


class Option:
    """One option: long name, short letter or '', name of its value or '' (a flag), help."""

    def __init__(self, name, short, value, text):
        self.name, self.short, self.value, self.text = name, short, value, text
        self.choices = []       # the words it takes, as far as the help says
        self.endings = None     # of files: endings without dot (none: any file)
        self.kind = ""          # "file", "folder", "port" or ""

    def spellings(self):
        return ["--" + self.name] + (["-" + self.short] if self.short else [])


class Command:
    """One command, a kind of one ("calibrate noise"), or the window (name '')."""

    def __init__(self, name, summary):
        self.name, self.summary = name, summary
        self.usage = []         # lines behind "Usage:"
        self.purpose = []       # lines, blank ones between paragraphs
        self.options = []
        self.example = []
        self.kinds = []         # commands of their own: noise, step, ..
        self.endings = ()       # of the files it takes as words
        self.ports = False      # takes ports as words
        self.requests = []      # what its first word can be (palpate remote)


def run(program, *words):
    """Standard output; the user's own settings and display have no say in it."""
    with tempfile.TemporaryDirectory() as home:
        keep = {name: os.environ[name] for name in ("PATH", "LD_LIBRARY_PATH") if name in os.environ}
        done = subprocess.run([program, *words], env={**keep, "HOME": home, "LC_ALL": "C.UTF-8"},
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, timeout=120,
                              encoding="utf-8", check=True)
    return done.stdout


def table(lines):
    """Lines "  NAME  what it is" up to the first blank one."""
    rows = []
    for line in lines:
        if not line.strip():
            break
        match = re.fullmatch(r"  ([a-z][a-z0-9-]*) +(\S.*)", line)
        if not match:
            raise ValueError("not a line of a table: " + repr(line))
        rows.append(match.groups())
    return rows


def grouped(lines):
    """The rows of all tables below headings "Look:", by name."""
    end = next(i for i, line in enumerate(lines) if line.startswith("Exit codes"))
    return sorted(table([line for line in lines[:end] if line.startswith("  ")]))


def join(lines, width):
    """Undoes the line breaks of Boost.Program_options: `width` is that of the column. It breaks at a
    blank, but within a word where that would leave less than half a line."""
    text = ""
    for line in lines:
        tail = len(line) - line.rfind(" ") - 1          # letters behind the last blank
        full = len(line) >= width and not line.endswith(" ")
        text += line.rstrip() + ("" if full and tail > width // 2 else " ")
    return text.strip()


def options(lines):
    start = r"  (?:-(\w) \[ --([\w-]+) \]|--([\w-]+))(?: (\S.*?))?"
    found, pending = [], None
    column = None
    for line in lines:                                  # every text begins in the same column
        match = re.match(r"  -h \[ --help \] +", line)
        if match:
            column = match.end()
    if column is None:
        raise ValueError("no --help among the options")
    for line in lines:
        if line.startswith("  -"):
            match = re.fullmatch(start + " *", line[:column].ljust(column)) or \
                re.fullmatch(start + " *", line)        # too long: its text stands below
            if not match:
                raise ValueError("not an option: " + repr(line))
            short, long1, long2, value = match.groups()
            pending = []
            found.append((long1 or long2, short or "", value or "", pending))
            if len(line) > column:
                pending.append(line[column:])
        else:
            pending.append(line[column:])
    width = 80 - 1 - column
    return [Option(name, short, value, join(text, width)) for name, short, value, text in found]


WORD = r"[a-z][a-z0-9]*(?:[-_][a-z0-9]+)*"
LIST = re.compile(r"(?:[^:;.,]*: )?((?:W(?: \(default[^)]*\))?(?:, or |, | or ))+W)(?: \([^)]*\))?"
                  r"(?=$|[;.,])".replace("W", WORD))


def listed(text):
    """The words of "svm, qda (default), lda or gauss" at the beginning of a text."""
    match = LIST.match(text)
    return re.findall(WORD, re.sub(r"\([^)]*\)| or ", " , ", match[1])) if match else []


def fill(command, option):
    """What the value of an option can be, of its name, the synopsis and the help."""
    def words(value):
        return [part for part in value.split("|") if re.fullmatch(WORD, part)]

    said = words(option.value)
    for match in re.finditer(r"--%s ([^\s\]]+)" % re.escape(option.name), " ".join(command.usage)):
        said += words(match[1]) if "|" in match[1] else []
    if option.value and not said:
        said = listed(option.text)
    if option.value and not said:
        match = re.search(r"\b%s: ([^.]*)\." % re.escape(option.value), " ".join(command.purpose))
        said = listed(match[1]) if match else []
    option.choices = list(dict.fromkeys(said))
    endings = re.findall(r"(?:\.|\{|,)([a-z][a-z0-9]{1,7})\b", option.value)
    if endings:
        option.kind, option.endings = "file", tuple(dict.fromkeys(endings))
    elif re.fullmatch(r"(NAME\|)?(DIR|FOLDER|OUTFOLDER|PATH2)", option.value):
        option.kind = "folder"
    elif option.value == "PORT":
        option.kind = "port"
    elif option.value == "FILE":
        option.kind, option.endings = "file", RECORDINGS
    elif re.fullmatch(r"OUT|LINK", option.value):
        option.kind, option.endings = "file", ()


def positional(command):
    endings = []
    for line in command.usage:
        rest = re.sub(r"--?[\w-]+ [^\s\]|]\S*", " ", line)      # options with their values
        for word in re.findall(r"(?<![\w.-])([A-Z][A-Z0-9]*)(\.[a-z]+)?(?:\.\.\.)?", rest):
            if word[1]:
                endings.append(word[1][1:])
            elif WORDS.get(word[0]) == "port":
                command.ports = True
            else:
                endings += WORDS.get(word[0], ())
    command.endings = tuple(dict.fromkeys(endings))
    said = re.search(r"REQUEST: (.*?)\.(?: |$)", re.sub(r" \([^)]*\)", "", " ".join(command.purpose)))
    command.requests = [each.split()[0] for each in said[1].split(", ")] if said else []


def read_command(program, name, summary, words):
    try:
        return take_apart(program, name, summary, words)
    except (ValueError, IndexError, StopIteration) as error:
        raise ValueError(f"palpate {' '.join(words)} --help can't be taken apart: {error}") from error


def take_apart(program, name, summary, words):
    command = Command(name, summary)
    lines = run(program, *words, "--help").splitlines()
    if not lines or not lines[0].startswith("Usage: "):
        raise ValueError("it doesn't begin with 'Usage:'")
    at = 0
    while lines[at].strip():
        command.usage.append(lines[at].removeprefix("Usage: ").strip())
        at += 1
    end = lines.index("Example:")
    command.example = [line.strip() for line in lines[end + 1:] if line.strip()]
    body = lines[at + 1:end]
    if "Options:" in body:
        split = body.index("Options:")
        command.options = options([line for line in body[split + 1:] if line.strip()])
        body = body[:split]
    else:
        first = next(i for i, line in enumerate(body) if re.match(r"  [a-z]", line))
        for kind, said in table(body[first:]):
            command.kinds.append(read_command(program, f"{name} {kind}", said, [*words, kind]))
    while body and not body[-1].strip():
        body.pop()
    command.purpose = body
    positional(command)
    for option in command.options:
        fill(command, option)
    return command


class Program:
    """All of it: version, the window, the commands, and the names that options take."""

    def __init__(self, program):
        self.version = run(program, "--version").split()[1]
        lines = run(program, "--help").splitlines()
        self.commands = [read_command(program, name, summary, [name])
                         for name, summary in grouped(lines[lines.index("Commands:") + 1:])]
        self.window = read_command(program, "", "the window", ["--demo"])
        filters = [line.split()[0] for line in run(program, "filter", "--list").splitlines()
                   if re.match(r"[a-z]", line)]
        hands = [hand["key"] for hand in json.loads(run(program, "hands", "--json"))["hands"]]
        for command in self.all():
            for option in command.options:
                if option.name == "hand":
                    option.choices = hands
                if option.name == "filter" and option.value == "SPEC":
                    option.choices = filters

    def all(self):
        """The window, every command, and every kind of one."""
        return [self.window] + [each for command in self.commands
                                for each in (command.kinds and [command, *command.kinds] or [command])]

    def scenes(self, names):
        for command in self.all():
            for option in command.options:
                if option.name == "scene":
                    option.choices = sorted(names)
