# SPDX-License-Identifier: LGPL-2.1-or-later
"""Inputs with one fault: scenes and mesh files, changed in one place."""

import dataclasses
import re

KEY = re.compile(r"^(\s*set\s+)([^=]+?)(\s*=\s*)(.*?)\s*$")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(\.\d*)?([eE][-+]?\d+)?(?![\w.])")
WEIRD = ("nan", "inf", "-inf", "1e400", "1e300", "-1e300", "1e15", "-1", "0", "1e-320", "abc", "",
         "1,5", "1 mm", "0x10", "--1", "1e", "sqrt(-1)", "1/0")


@dataclasses.dataclass(frozen=True)
class Mutation:
    """Contents of the scene file and of the mesh beside it, and what was changed."""
    what: str
    scene: str
    mesh: bytes = None
    # Whether there is nothing that the program could take for granted.
    wrong: bool = False


def _lines(text):
    """Numbers of lines with a key, and all lines."""
    lines = text.splitlines()
    return [i for i, line in enumerate(lines) if KEY.match(line)], lines


def _joined(lines):
    return "\n".join(lines) + "\n"


def delete_key(rng, text):
    keys, lines = _lines(text)
    i = rng.choice(keys)
    return Mutation(f"without '{lines[i].strip()}'", _joined(lines[:i] + lines[i + 1:]))


def misspell_key(rng, text):
    keys, lines = _lines(text)
    i = rng.choice(keys)
    head, name, equals, value = KEY.match(lines[i]).groups()
    at = rng.randrange(len(name))
    wrong = rng.choice((name[:at] + name[at + 1:], name[:at] + "x" + name[at:], name.upper(),
                        name + " 2"))
    lines[i] = head + wrong + equals + value
    return Mutation(f"key '{name}' as '{wrong}'", _joined(lines), wrong=True)


def misspell_value(rng, text):
    keys, lines = _lines(text)
    words = [i for i in keys if re.search("[A-Za-z]{3}", KEY.match(lines[i])[4]) and
             KEY.match(lines[i])[2] != "Title"]
    i = rng.choice(words)
    head, name, equals, value = KEY.match(lines[i]).groups()
    at = rng.choice([m.start() for m in re.finditer("[A-Za-z]", value)])
    wrong = value[:at] + rng.choice(("q", "", "  ", ",")) + value[at + 1:]
    lines[i] = head + name + equals + wrong
    return Mutation(f"'{name}' = '{wrong}' instead of '{value}'", _joined(lines))


def change_number(rng, text):
    keys, lines = _lines(text)
    with_number = [i for i in keys if NUMBER.search(KEY.match(lines[i])[4]) and
                   KEY.match(lines[i])[2] != "Title"]
    i = rng.choice(with_number)
    head, name, equals, value = KEY.match(lines[i]).groups()
    match = rng.choice(list(NUMBER.finditer(value)))
    new = rng.choice(WEIRD)
    wrong = value[:match.start()] + new + value[match.end():]
    lines[i] = head + name + equals + wrong
    # A condition such as 'if(t < 1/0, ...)' may well be infinite.
    certain = "(" not in value and new in ("nan", "inf", "-inf", "1e400", "abc", "1 mm", "--1", "1e", "sqrt(-1)", "1/0")
    return Mutation(f"'{name}' = '{wrong}' instead of '{value}'", _joined(lines), wrong=certain)


def change_list(rng, text):
    keys, lines = _lines(text)
    lists = [i for i in keys if "," in KEY.match(lines[i])[4] and KEY.match(lines[i])[2] != "Title"]
    i = rng.choice(lists or keys)
    head, name, equals, value = KEY.match(lines[i]).groups()
    parts = [p.strip() for p in value.split(",")]
    at = rng.randrange(len(parts))
    wrong = ", ".join(rng.choice((parts[:at] + parts[at + 1:], parts + [parts[at]],
                                  parts[:at] + [""] + parts[at + 1:])))
    wrong = rng.choice((wrong, value.replace(",", ";"), value.replace(",", " ")))
    lines[i] = head + name + equals + wrong
    return Mutation(f"'{name}' = '{wrong}' instead of '{value}'", _joined(lines))


def double_line(rng, text):
    """A key twice with two values, or a section end more or less."""
    keys, lines = _lines(text)
    if rng.random() < 0.5:
        i = rng.choice(keys)
        head, name, equals, value = KEY.match(lines[i]).groups()
        return Mutation(f"'{name}' twice", _joined(lines[:i + 1] + [head + name + equals + "7"] +
                                                   lines[i + 1:]), wrong=True)
    i = rng.choice([i for i, line in enumerate(lines)
                    if line.strip() == "end" or line.strip().startswith("subsection")])
    how = rng.choice(("without", "twice"))
    return Mutation(f"{how} line {i + 1}, '{lines[i].strip()}'",
                    _joined(lines[:i] + ([lines[i]] * 2 if how == "twice" else []) + lines[i + 1:]),
                    wrong=True)


def rename(rng, text):
    """A name that nothing has, or another body's."""
    keys, lines = _lines(text)
    known = ("Slave body", "Master body", "Slave boundaries", "Master boundaries", "Fixed",
             "Symmetry", "Bodies", "Obstacle", "Obstacles", "Contact pairs", "Boundary conditions",
             "Volume", "File", "Pair")
    i = rng.choice([i for i in keys if KEY.match(lines[i])[2] in known])
    head, name, equals, value = KEY.match(lines[i]).groups()
    others = [KEY.match(lines[j])[4] for j in keys if KEY.match(lines[j])[2] in known]
    wrong = rng.choice(("nothing", rng.choice(others), value + ", " + value, "7", "a/b", '"'))
    lines[i] = head + name + equals + wrong
    return Mutation(f"'{name}' = '{wrong}' instead of '{value}'", _joined(lines))


def cut_text(rng, text):
    at = rng.randrange(len(text))
    return Mutation(f"the scene ends after {at} of {len(text)} characters", text[:at])


OF_SCENES = (delete_key, misspell_key, misspell_value, change_number, change_number, change_list,
             double_line, rename, rename, cut_text)


def mesh(rng, scene, data):
    """A fault in the mesh file of a scene."""
    lines = data.split(b"\n")
    # Of these formats each line of numbers counts.
    counted = data.startswith((b"$MeshFormat", b"# vtk", b"<?xml"))
    wrong = False

    def of_numbers(line):
        return counted and re.fullmatch(rb"[-+.,\deE\s]*\d[-+.,\deE\s]*", line) is not None

    kind = rng.choice(("cut", "byte", "number", "line", "swap", "double"))
    i = rng.randrange(len(lines))
    if kind == "cut":
        at = rng.randrange(len(data))
        return Mutation(f"mesh ends after {at} of {len(data)} bytes", scene, data[:at])
    if kind == "byte":
        at = rng.randrange(len(data))
        new = bytes([rng.randrange(256)])
        return Mutation(f"mesh, byte {at}: {new!r}", scene, data[:at] + new + data[at + 1:])
    if kind == "number":
        i = rng.choice([j for j, line in enumerate(lines) if re.search(rb"\d", line)])
        match = rng.choice(list(re.finditer(rb"[-+.\deE]*\d[.\deE]*", lines[i])))
        new = rng.choice((b"nan", b"inf", b"-1", b"0", b"999999999", b"99999999999999999999",
                          b"1e300", b"x", b""))
        wrong = of_numbers(lines[i]) and new in (b"nan", b"inf", b"x")
        lines[i] = lines[i][:match.start()] + new + lines[i][match.end():]
        what = f"{new!r} for {match[0]!r} in line {i + 1}"
    elif kind == "line":
        what = f"without line {i + 1}"
        wrong = of_numbers(lines[i])
        del lines[i]
    elif kind == "double":
        what = f"line {i + 1} twice"
        wrong = of_numbers(lines[i])
        lines.insert(i, lines[i])
    else:
        j = rng.randrange(len(lines))
        lines[i], lines[j] = lines[j], lines[i]
        what = f"lines {i + 1} and {j + 1} exchanged"
    return Mutation("mesh, " + what, scene, b"\n".join(lines), wrong)
