# SPDX-License-Identifier: LGPL-2.1-or-later
"""The documents do what they say. This check looks for the targets of all links,
for every scene of prm/ in the gallery, and runs, page by page, the commands of doc/tutorials/*.md:

* In a block ```console a line "$ build/touchstone ..." is run (other commands, such as those of editors
  and compilers, are not), "\\" continues it. Each of the lines below it, but "...", must be printed
  by the run, with the same words and with numbers that agree to their last digit.
* In a block ```prm or ```cpp, below a line that ends with the name of a file in backquotes and a colon,
  all lines but "..." are lines of that file, in this order.
* A comment "<!-- must: PATH <= NUMBER -->" (or >=) bounds a figure in summary.json of the last run.

Needs Python 3.9 and nothing else.
"""

import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

sys.dont_write_bytecode = True  # no folders __pycache__ among the sources
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from processors import processors  # pylint: disable=wrong-import-position

NUMBER = re.compile(r"[-+]?\d[\d,]*\.?\d*(?:[eE][-+]?\d+)?")
failures = []


def fail(page, message):
    print(f"FAILED: {page.name}: {message}", flush=True)
    failures.append(message)


def agree(shown, printed):
    """The same words, and numbers that agree to the last digit that is shown."""
    shown, printed = (re.sub(r"\s+", " ", line.strip()) for line in (shown, printed))
    if NUMBER.sub("#", shown) != NUMBER.sub("#", printed):
        return False
    for text, other in zip(NUMBER.findall(shown), NUMBER.findall(printed)):
        mantissa, _, exponent = text.replace(",", "").lower().partition("e")
        digits = len(mantissa.partition(".")[2])
        unit = 10.0 ** (int(exponent or 0) - digits)
        if abs(float(text.replace(",", "")) - float(other.replace(",", ""))) > 1.01 * unit:
            return False
    return True


def run(page, command, program, project, folder):
    """What the command prints, and its summary.json."""
    words = [str(program)] + shlex.split(command)[1:]
    if "--output" not in words:
        words[1:1] = ["--output", str(folder)]
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1")
    environment.pop("TOUCHSTONE_OPTIONS", None)
    with processors():
        done = subprocess.run(words, cwd=project, env=environment, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        fail(page, f"{command}\nends with exit code {done.returncode}:\n{done.stdout[-800:]}")
        return [], {}
    summary = pathlib.Path(folder) / "summary.json"
    return done.stdout.splitlines(), json.loads(summary.read_text(encoding="utf-8")) if summary.exists() else {}


def console(page, block, program, project, folder):
    """Run the commands of a block; the summary of the last one."""
    output, summary, command = None, None, None
    for line in block:
        if command is not None and command.endswith("\\"):
            command = command[:-1] + line.strip()
        elif line.startswith("$ "):
            command, output = line[2:], None
        elif output is not None and line.strip() not in ("", "..."):
            if not any(agree(line, printed) for printed in output):
                words = NUMBER.split(line.strip())[0].strip()
                near = [p.strip() for p in output if words and p.strip().startswith(words)]
                fail(page, f"'{line.strip()}' is not printed by {command}; but: {near[:3]}")
            continue
        if command and not command.endswith("\\") and output is None and command.startswith("build/touchstone"):
            print(f"{page.name}: {command}", flush=True)
            output, summary = run(page, command, program, project, folder)
    return summary


def excerpt(page, block, file):
    """All lines of the block are lines of the file, in this order."""
    if not file.exists():
        return fail(page, f"there is no file {file}")
    lines = iter([line.strip() for line in file.read_text(encoding="utf-8").splitlines()])
    for line in block:
        if line.strip() not in ("", "...") and line.strip() not in lines:
            return fail(page, f"'{line.strip()}' is not, or not here, in {file}")


def value_at(summary, path):
    for key in path.split("/"):
        summary = summary[int(key)] if isinstance(summary, list) else summary[key]
    return float(summary)


def bound(page, text, summary):
    path, relation, limit = re.fullmatch(r"(.*?) (<=|>=) (\S+)", text).groups()
    try:
        value = value_at(summary, path)
    except (KeyError, IndexError, TypeError):
        return fail(page, f"the last run has no figure '{path}'")
    if not (value <= float(limit) if relation == "<=" else value >= float(limit)):
        fail(page, f"{path} is {value}, and not {relation} {limit}")


def check(page, program, project, folder):
    kind, block, file, summary, runs = None, [], None, None, 0
    for line in page.read_text(encoding="utf-8").splitlines():
        if line.startswith("```"):
            if kind is None:
                kind, block = line[3:].strip() or "text", []
                continue
            if kind == "console":
                new = console(page, block, program, project, folder)
                summary, runs = (summary, runs) if new is None else (new, runs + 1)
            elif kind in ("prm", "cpp"):
                if file is None:
                    fail(page, f"no file is named before the block '{block[0]}'")
                else:
                    excerpt(page, block, project / file)
            kind = None
        elif kind is not None:
            block.append(line)
        else:
            must = re.fullmatch(r"<!-- must: (.*?) -->", line.strip())
            if must:
                bound(page, must[1], summary)
            elif line.strip():
                named = re.search(r"`([\w./-]+)`:$", line)
                file = named[1] if named else None
    if runs == 0 and "console" in page.read_text(encoding="utf-8"):
        print(f"{page.name}: no command of this page is run here")


def slug(heading):
    """The anchor that a heading has on the usual sites."""
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def prose(page):
    """The page without its blocks of code and comments."""
    text = re.sub(r"^```.*?^```", "", page.read_text(encoding="utf-8"), flags=re.S | re.M)
    return re.sub(r"<!--.*?-->|^    [^\n]*$|`[^`\n]*`", "", text, flags=re.S | re.M)


def links(project):
    """The files and headings that links name exist."""
    pages = [*project.glob("*.md"), *(project / "doc").rglob("*.md")]
    for page in pages:
        for target in re.findall(r"\]\(([^)\s]+)\)", prose(page)):
            if re.match("https?:|mailto:", target):
                continue
            path, _, anchor = target.partition("#")
            file = (page.parent / path).resolve() if path else page
            if not file.exists():
                fail(page, f"the link to {target} leads nowhere")
            elif anchor and file.suffix == ".md":
                headings = re.findall(r"^#+ (.*)$", file.read_text(encoding="utf-8"), re.M)
                if anchor not in map(slug, headings):
                    fail(page, f"{path or page.name} has no heading '{anchor}'")


def gallery(project):
    """Every shipped scene is in the gallery, with its command."""
    page = project / "doc/gallery.md"
    text = page.read_text(encoding="utf-8")
    for scene in sorted((project / "prm").rglob("*.prm")):
        command = f"build/touchstone {scene.relative_to(project)}`"
        if command not in text:
            fail(page, f"'{command[:-1]}' is not there")


def main():
    program, project, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    folder.mkdir(parents=True, exist_ok=True)
    pages = sorted((project / "doc/tutorials").glob("*.md"))
    if not pages:
        sys.exit("there are no tutorials")
    links(project)
    gallery(project)
    for page in pages:
        check(page, program, project, folder / page.stem)
    if failures:
        sys.exit(f"{len(failures)} check(s) failed")
    print(f"{len(pages)} tutorials")


main()
