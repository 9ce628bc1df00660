"""The man page palpate(1), from what the program says of itself."""
import re

BEFORE = r"""
.SH DESCRIPTION
Palpate records, shows, plays and measures what the tactile sensor matrices, joints and temperature sensors of a robot
hand (SCHUNK SDH-2) deliver.
It connects to a hand over two serial ports, or to an emulated hand that speaks the same protocols.
Without a command it opens its window; with a command it works without one.
.PP
Recordings are files
.I *.palpate
and
.IR *.dsa .
No command replaces a file without
.BR --force .
"""

AFTER = r"""
.SH EXIT STATUS
.TP
.B 0
done
.TP
.B 1
failed; one line on standard error says what, where and what to do
.TP
.B 2
wrong usage
.TP
.B 3
done in part: the input is damaged and the output says how much was saved, or some of several files failed
.SH ENVIRONMENT
.TP
.B PALPATE_DATA
folder of the program's own data: scenes, the demonstration recording, the model of emulated objects; default
.I /usr/share/palpate
.TP
.B PALPATE_FFMPEG
the program that makes movies; default
.B ffmpeg
in
.B PATH
.SH FILES
.TP
.I ~/.config/palpate
settings of the window
.TP
.I /usr/share/palpate
data that comes with the program
.TP
.I /usr/share/doc/palpate
how each number is computed, the file formats, how to connect a hand
.TP
.I /dev/serial/by-id
serial ports by names that stay; using them takes the group
.B dialout
.SH SEE ALSO
.BR ffmpeg (1),
.BR udev (7)
"""


def escaped(text):
    """Text for troff: no letter of it is a request, and every hyphen is one that can be copied."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("`", "\\(ga")
    text = text.replace("^", "\\(ha").replace("~", "\\(ti")
    return "\\&" + text if text.startswith(".") else text


def prose(lines):
    """Paragraphs are filled; indented lines stay as they are."""
    out, table = [], False
    for line in lines:
        indented = line.startswith("  ")
        if indented != table:
            out.append(".RS 2\n.nf" if indented else ".fi\n.RE")
            table = indented
        out.append(escaped(line.strip() if not indented else line[2:]) if line.strip() else
                   ("" if table else ".PP"))
    if table:
        out.append(".fi\n.RE")
    return [line for line in out if line]


def synopsis(lines):
    """The literal part bold: `palpate info`."""
    out = []
    for line in lines:
        words = re.match(r"palpate(?: [a-z][a-z-]*(?= |$))*", line)
        end = words.end() if words else 0  # a long synopsis goes on in a second line
        head, rest = line[:end], line[end:]
        out.append(f"\\fB{escaped(head)}\\fR{escaped(rest)}")
    return [".nf"] + out + [".fi"]


def option_lines(options):
    out = []
    for option in options:
        spellings = ", ".join(f"\\fB{escaped(each)}\\fR" for each in reversed(option.spellings()))
        value = f" \\fI{escaped(option.value)}\\fR" if option.value else ""
        out += [".TP", spellings + value, escaped(option.text)]
    return out


def own_options(command):
    return [option for option in command.options if option.name not in ("help", "quiet")]


def section(command):
    out = [f".SS palpate {escaped(command.name)}"]
    out += synopsis(command.usage) + [".PP"] + prose(command.purpose) + option_lines(own_options(command))
    if command.example:
        out += [".PP", "Example:", ".PP", ".RS 2", ".nf"]
        out += [escaped(line) for line in command.example] + [".fi", ".RE"]
    return out


def man_page(program, date):
    out = ['.\\" Made of what palpate --help says: see cmake/package/pages.',
           f'.TH PALPATE 1 "{date}" "Palpate {program.version}" "User Commands"',
           ".SH NAME", "palpate \\- workbench for tactile robot hands", ".SH SYNOPSIS"]
    usage = program.window.usage[0].split(" | ")
    out += synopsis(usage + ["palpate COMMAND .."])
    out += [BEFORE.strip(), ".SH OPTIONS OF THE WINDOW"] + option_lines(own_options(program.window))
    out += [".TP", r"\fB\-\-version\fR", "print the version of the program"]
    out += [".SH COMMANDS"]
    for command in program.commands:
        out += [".TP", f"\\fB{escaped(command.name)}\\fR", escaped(command.summary)]
    out += [".PP", "Every command also takes",
            ".BR \\-h ", "or", ".B \\-\\-help", "(its own help) and", ".B \\-q", "or", ".B \\-\\-quiet",
            "(no progress and no remarks; errors are still printed)."]
    out += [".SH COMMANDS IN DETAIL"]
    for command in program.commands:
        for each in [command] + command.kinds:
            out += section(each)
    return "\n".join(out + [AFTER.strip()]) + "\n"
