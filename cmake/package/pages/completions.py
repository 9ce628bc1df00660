"""Completion of commands, options, their values and file endings for bash, zsh and fish."""

HEAD = "# Made of what palpate --help says: see cmake/package/pages.\n"
PORTS = "/dev/serial/by-id/*"


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def values(program):
    """Options with a value, by what completes it: {what: [(command, option)]}, in order."""
    return [(command, option) for command in program.all() for option in command.options if option.value]


# ---- bash ----

def bash_action(choices, kind, endings):
    out = []
    if choices:
        out.append("_palpate_words " + quoted(" ".join(choices)))
    if kind == "port":
        out.append("_palpate_ports")
    if kind == "folder":
        out.append("_filedir -d")
    if kind == "file":
        out.append("_filedir" + (f" '@({'|'.join(endings)})'" if endings else ""))
    return "; ".join(out) or ":"    # a number, a name: nothing to offer


def bash(program):
    kinds = {command.name: command.kinds for command in program.commands if command.kinds}
    names = " ".join(command.name for command in program.commands)
    helped = {name: [kind.name.split()[1] for kind in of] for name, of in kinds.items()}
    lines = [HEAD.rstrip(), """
_palpate_words() {
  COMPREPLY+=($(compgen -W "$1" -- "$cur"))
}
_palpate_ports() {
  local port
  for port in /dev/serial/by-id/*; do
    [[ -e $port && $port == "$cur"* ]] && COMPREPLY+=("$port")
  done
  _filedir
}

_palpate() {
  local cur prev words cword split
  _init_completion -s || return
  # The command is the first word, its kind (calibrate noise) the second.
  local command= at=1
  if ((cword > 1)); then
    command=${words[1]}
    if [[ $command == help ]]; then""",
             f"      ((cword == 2)) && _palpate_words '{names}'"]
    for name, of in helped.items():
        lines.append(f"      ((cword == 3)) && [[ ${{words[2]}} == {name} ]] && _palpate_words '{' '.join(of)}'")
    lines += ["      return 0", "    fi", "    case $command in"]
    for name, of in kinds.items():
        lines.append(f"      {name}) ((cword > 2)) && command+=\" ${{words[2]}}\" at=2 ;;")
    lines += ["    esac", "  fi", "  case $command in", f"    {'|'.join(names.split())}) ;;"]
    for of in kinds.values():
        lines.append("    " + "|".join(quoted(kind.name) for kind in of) + ") ;;")
    lines += ["    *) command= ;;", "  esac", "", "  case \"$command $prev\" in"]
    for command, option in values(program):
        patterns = "|".join(quoted(f"{command.name} {each}") for each in option.spellings())
        action = bash_action(option.choices, option.kind, option.endings or ())
        lines.append(f"    {patterns}) {action}; return ;;")
    lines += ["  esac", "  $split && return", "", "  local options= endings= kinds= requests=", "  case $command in"]
    for command in program.all():
        options = " ".join(each for option in command.options for each in option.spellings())
        if command.name in kinds:
            lines.append(f"    {command.name}) kinds={quoted(' '.join(k.name.split()[1] for k in kinds[command.name]))}"
                         " options='--help -h' ;;")
            continue
        endings = f" endings='@({'|'.join(command.endings)})'" if command.endings else ""
        ports = " endings=ports" if command.ports else ""
        ports += f" requests={quoted(' '.join(command.requests))}" if command.requests else ""
        more = " --version" if not command.name else ""
        lines.append(f"    {quoted(command.name)}) options={quoted(options + more)}{endings}{ports} ;;")
    lines += ["  esac", f"""  if [[ $cur == -* ]]; then
    _palpate_words "$options"
    return
  fi
  ((cword == 1)) && _palpate_words 'help {names}'
  [[ -n $kinds ]] && _palpate_words "$kinds"
  if [[ -n $requests ]]; then
    ((cword == 2)) && _palpate_words "$requests"
    return 0
  fi
  case $endings in
    '') ((cword == 1)) || [[ -n $kinds ]] || _filedir -d ;;
    ports) _palpate_ports ;;
    *) _filedir "$endings" ;;
  esac
}}
complete -F _palpate palpate"""]
    return "\n".join(lines) + "\n"


# ---- zsh ----

def zsh_text(text):
    return text.replace("\\", "\\\\").replace("[", "\\[").replace("]", "\\]").replace(":", "\\:")


def zsh_files(endings):
    """Folders always, files with these endings in any case."""
    return "_files" if not endings else f'_files -g "(#i)*.({"|".join(endings)})(-.)"'


def zsh_action(choices, kind, endings):
    files = {"file": zsh_files(endings), "folder": "_files -/", "port": "_palpate_ports"}.get(kind)
    words = f"compadd {' '.join(choices)}" if choices else None
    if words and files:
        return f"{{ {words}; {files} }}"
    return f"({' '.join(choices)})" if words else files or " "


def zsh_spec(option):
    text = f"[{zsh_text(option.text)}]"
    value = f":{zsh_text(option.value)}:{zsh_action(option.choices, option.kind, option.endings or ())}" \
        if option.value else ""
    equals = "=" if option.value else ""
    specs = [f"*--{option.name}{equals}{text}{value}"]
    if option.short:
        specs.append(f"*-{option.short}{'+' if option.value else ''}{text}{value}")
    return [quoted(spec) for spec in specs]


def zsh_arguments(command):
    words = f"({' '.join(command.requests)})" if command.requests else \
        "_palpate_ports" if command.ports else \
        zsh_files(command.endings) if command.endings else "_files -/"
    specs = [spec for option in command.options for spec in zsh_spec(option)]
    return " \\\n        ".join(["_arguments -s -S"] + specs + [quoted(f"*:file:{words}")])


def zsh(program):
    lines = ["#compdef palpate", HEAD.rstrip(), """
_palpate_ports() {
  local -a ports=(/dev/serial/by-id/*(N))
  (( $#ports )) && compadd -a ports
  _files
}
"""]
    lines += ["_palpate_commands() {", "  local -a commands=("]
    lines += ["    " + quoted("help:explains a command")]
    lines += ["    " + quoted(f"{c.name}:{c.summary}") for c in program.commands]
    lines += ["  )", "  _describe -t commands command commands", "}", ""]
    for command in program.commands:
        if command.kinds:
            lines += [f"_palpate_{command.name}_kinds() {{", "  local -a kinds=("]
            lines += ["    " + quoted(f"{k.name.split()[1]}:{k.summary}") for k in command.kinds]
            lines += ["  )", "  _describe -t kinds kind kinds", "}", ""]
    lines += ["_palpate() {", "  local curcontext=$curcontext name=$words[2]",
              "  if (( CURRENT == 2 )) && [[ $words[2] != -* ]]; then",
              "    _palpate_commands", "  fi", "  if (( CURRENT > 2 )); then", "    case $name in",
              "      help) (( CURRENT == 3 )) && _palpate_commands; return ;;"]
    for command in program.commands:
        if not command.kinds:
            lines += [f"      {command.name})", "        shift words; (( CURRENT-- ))",
                      "        " + zsh_arguments(command), "        return ;;"]
            continue
        lines += [f"      {command.name})",
                  f"        (( CURRENT == 3 )) && {{ _palpate_{command.name}_kinds; return }}",
                  "        local kind=$words[3]", "        shift 2 words; (( CURRENT -= 2 ))", "        case $kind in"]
        for kind in command.kinds:
            lines += [f"        {kind.name.split()[1]})", "        " + zsh_arguments(kind), "        ;;"]
        lines += ["        esac", "        return ;;"]
    lines += ["    esac", "  fi", "        " + zsh_arguments(program.window), "}", "", '_palpate "$@"']
    return "\n".join(lines) + "\n"


# ---- fish ----

def fish_files(endings):
    return "(__palpate_files " + " ".join(endings) + ")"


def fish_option(condition, option):
    parts = [f"complete -c palpate -n {quoted(condition)} -l {option.name}"]
    if option.short:
        parts.append(f"-s {option.short}")
    if option.value:
        offered = list(option.choices)
        if option.kind == "file" and option.endings:
            offered.append(fish_files(option.endings))
        if option.kind == "folder":
            offered.append("(__fish_complete_directories)")
        if option.kind == "port":
            offered.append(PORTS)
        any_file = option.kind == "port" or (option.kind == "file" and not option.endings)
        parts.append("-r" + (" -F" if any_file else " -f"))
        if offered:
            parts.append("-a " + quoted(" ".join(offered)))
    parts.append("-d " + quoted(option.text))
    return " ".join(parts)


def fish(program):
    names = " ".join(command.name for command in program.commands)
    lines = [HEAD.rstrip(), f"""
set -g __palpate_commands {names} help
# The words given so far begin with these, or (without any) with no command.
function __palpate_in
    set -l given (commandline -opc)
    set -e given[1]
    set -l depth (count $argv)
    if test $depth -eq 0
        not contains -- "$given[1]" $__palpate_commands
        return
    end
    test (count $given) -ge $depth; and test "$given[1..$depth]" = "$argv"
end
# The next word is the one right behind these.
function __palpate_first
    test (count (commandline -opc)) -eq (math 1 + (count $argv)); or return
    test (count $argv) -eq 0; or __palpate_in $argv
end
# Folders, and files with these endings in any case.
function __palpate_files
    set -l endings (string join '|' -- $argv)
    string match -ri -- "^.*(?:/|\\.(?:$endings))\\$" (complete -C "__palpate_any_file "(commandline -ct))
end
complete -c palpate -f
complete -c palpate -n __palpate_first -l version -d 'version of the program'
complete -c palpate -n __palpate_first -a help -d 'explains a command'
complete -c palpate -n '__palpate_first help' -a '{names}'"""]
    for command in program.commands:
        lines.append(f"complete -c palpate -n __palpate_first -a {command.name} -d {quoted(command.summary)}")
        for kind in command.kinds:
            lines.append(f"complete -c palpate -n '__palpate_first {command.name}' "
                         f"-a {kind.name.split()[1]} -d {quoted(kind.summary)}")
    for command in program.all():
        if command.kinds:
            continue
        condition = f"__palpate_in {command.name}".strip()
        lines += [fish_option(condition, option) for option in command.options]
        if command.requests:
            lines.append(f"complete -c palpate -n '__palpate_first {command.name}' -a {quoted(' '.join(command.requests))}")
        elif command.ports:
            lines.append(f"complete -c palpate -n {quoted(condition)} -F -a {quoted(PORTS)}")
        elif command.endings:
            lines.append(f"complete -c palpate -n {quoted(condition)} -a {quoted(fish_files(command.endings))}")
        else:
            lines.append(f"complete -c palpate -n {quoted(condition)} -a '(__fish_complete_directories)'")
    return "\n".join(lines) + "\n"
