#!/usr/bin/python3
"""Finds the programs that a shell script calls, by reading it: the words that stand where a command does.

  shell_words.py FILE      prints them, a line each

Understands quotes, comments, $( ), case, here-documents, assignments and redirections, and words that take a command
themselves (env, xargs, sudo, ..). Commands whose name is computed aren't seen."""

import re
import sys
from pathlib import Path

# Words behind which a command stands, with options of their own before it.
WITH_COMMAND = {"then", "do", "else", "elif", "if", "while", "until", "time", "!", "{", "exec", "eval", "command", "builtin",
                "nohup", "xargs", "sudo", "env", "coproc"}
END_OF_COMMANDS = {"fi", "done", "esac"}


def lexed(text):
    """Tokens of a shell script: ("word", text without quotes), ("operator", text). Commands in $( ) and "$( )" come as tokens
    of their own, between the operators ( and )."""
    at, word, tokens, after = 0, None, [], []

    def end_word():
        nonlocal word
        if word is not None:
            tokens.append(("word", word))
            tokens.extend(after)
            after.clear()
        word = None

    def end_of_parenthesis(start):
        depth, quote, i = 1, "", start
        while i < len(text) and depth:
            c = text[i]
            if c == "\\" and quote != "'":
                i += 1
            elif quote:
                quote = "" if c == quote else quote
            elif c in "'\"":
                quote = c
            else:
                depth += (c == "(") - (c == ")")
            i += 1
        return i

    while at < len(text):
        c = text[at]
        if c == "\\":
            if text[at + 1:at + 2] != "\n":  # else the line goes on
                word = (word or "") + text[at + 1:at + 2]
            at += 2
        elif c == "'":
            end = text.find("'", at + 1)
            end = len(text) if end < 0 else end
            word = (word or "") + text[at + 1:end]
            at = end + 1
        elif c == '"':
            word, at = (word or ""), at + 1
            while at < len(text) and text[at] != '"':
                if text[at] == "\\":
                    at += 1
                elif text.startswith("$(", at) and not text.startswith("$((", at):
                    end = end_of_parenthesis(at + 2)
                    after += [("operator", "("), *lexed(text[at + 2:end - 1]), ("operator", ")")]
                    word, at = word + "$", end
                    continue
                word, at = word + text[at:at + 1], at + 1
            at += 1
        elif text.startswith("${", at):
            end = text.find("}", at)
            word, at = (word or "") + "$", (len(text) if end < 0 else end + 1)
        elif text.startswith("$((", at):
            word, at = (word or "") + "$", end_of_parenthesis(at + 2)
        elif text.startswith("$(", at) or text.startswith("<(", at):
            end = end_of_parenthesis(at + 2)
            after += [("operator", "("), *lexed(text[at + 2:end - 1]), ("operator", ")")]
            word, at = (word or "") + "$", end
        elif text.startswith("<<<", at):
            end_word()
            at += 3
        elif text.startswith("<<", at):
            here = re.compile(r"<<-?\s*(['\"]?)(\w+)\1").match(text, at)
            end_word()
            at = here.end() if here else at + 2
            if here:  # what stands between is no command
                close = re.compile(rf"^\s*{here[2]}$", re.MULTILINE).search(text, at)
                line_end = text.find("\n", at)
                if close and line_end >= 0:
                    text = text[:line_end] + text[close.end():]
        elif c == "#" and word is None:
            at = text.find("\n", at)
            at = len(text) if at < 0 else at
        elif c in " \t":
            end_word()
            at += 1
        elif c in ";|&()\n":
            if c == "&" and at and text[at - 1] in "<>" or c == "&" and text[at + 1:at + 2] == ">":
                word, at = (word or "") + c, at + 1  # 2>&1, &>
                continue
            end_word()
            double = text[at:at + 2] in (";;", "&&", "||")
            tokens.append(("operator", text[at:at + 2] if double else c))
            at += 2 if double else 1
        else:
            word, at = (word or "") + c, at + 1
    end_word()
    return tokens


def command_words(text):
    """The words of a shell script that stand where a program's name does."""
    words, stack, functions = set(), [], set(re.findall(r"^\s*([a-z]\w*)\(\)", text, re.MULTILINE))
    # State: is the next word a command; are we in the patterns of a case; does a word of WITH_COMMAND wait for its command.
    command, patterns, waiting, redirected = True, False, False, False
    before = None
    for kind, token in lexed(text):
        before, last = (kind, token), before
        if kind == "operator":
            if token == ")" and last == ("operator", "("):  # name()
                stack.pop()
                command, waiting = True, False
            elif token == "(" and not patterns:
                stack.append((command, patterns, waiting))
                command, waiting = True, False
            elif token == ")" and patterns:
                command, patterns, waiting = True, False, False
            elif token == ")" and stack:
                command, patterns, waiting = stack.pop()
            elif token == ";;":
                command, patterns, waiting = False, True, False
            elif not patterns:
                command, waiting = True, False
            continue
        if token == "esac":
            command, patterns = True, False
        elif token == "case" and command:
            command = False
            stack.append("case")
        elif token == "in" and stack and stack[-1] == "case":
            stack.pop()
            patterns = True
        elif patterns:
            pass
        elif redirected:
            redirected = False
        elif re.match(r"\d*(<|>|&>)", token):
            redirected = re.fullmatch(r"\d*(<|>>?|&>)\|?", token) is not None
        elif command and re.match(r"\w+\+?=", token):
            pass
        elif token == "{" or (command and token in WITH_COMMAND):
            waiting = token in ("command", "exec", "nohup", "xargs", "sudo", "env", "time")
            if token in ("nohup", "xargs", "sudo", "env"):
                words.add(token)
        elif command and waiting and (token.startswith("-") or re.fullmatch(r"[\d.]*|\\n|[A-Z_]+", token)):
            pass
        elif command:
            command = False
            if re.fullmatch(r"[A-Za-z][\w.+-]*|/[\w/.+-]+", token) and token not in END_OF_COMMANDS:
                words.add(token)
    return words - functions


if __name__ == "__main__":
    print("\n".join(sorted(command_words(Path(sys.argv[1]).read_text()))))
