# SPDX-License-Identifier: LGPL-2.1-or-later
"""All runs of a campaign, and what is written of them."""

import itertools
import shlex

from . import calculix, diagrams, table, touchstone, with_getfem

# What the optional programs are called where they are missing.
OTHERS = {"calculix": (calculix, "ccx", "CalculiX"),
          "getfem": (with_getfem, "python3-getfem", "GetFEM")}


def leave_out_missing(campaign):
    """Without the contenders whose program is not installed, which is said."""
    for name, (module, package, title) in OTHERS.items():
        if not any(c.program == name for c in campaign.cases) or module.installed():
            continue
        print(f"  {package} is not installed: without {title}")
        campaign.cases = [c for c in campaign.cases if c.program != name]


def execute(program, case, campaign, own, models):
    """One run, which is told of. @return See touchstone.execute()"""
    if case.program in OTHERS:
        run = OTHERS[case.program][0].execute(program, case, campaign, own, models)
    else:
        run = touchstone.execute(program, case, campaign, own)
    (own / "command").write_text(shlex.join(run["command"]) + "\n", encoding="utf-8")
    return run


def run_all(campaign, program, folder, known):
    """All runs of a campaign, round after round. @return rows of the table.
    @param known Rows by contender and mesh that are taken as they are."""
    runs, models = {}, {}

    def rows():
        return [known.get((case.line, case.mesh)) or
                table.median_row(case, runs[case.folder], campaign) for case in campaign.cases
                if (case.line, case.mesh) in known or case.folder in runs]

    # Mesh after mesh, so that contenders alternate.
    order = sorted(campaign.cases, key=lambda case: campaign.meshes.index(case.mesh))
    for turn in range(campaign.repeat):
        for case in order:
            if (case.line, case.mesh) in known:
                continue
            done = runs.setdefault(case.folder, [])
            if any(run["reason"] for run in done):
                continue  # it would fail again
            run = execute(program, case, campaign, folder / "runs" / case.folder, models)
            result = run["reason"] or ", ".join(f"{n} {e:.1e}" for n, e in run["errors"].items()
                                                if n in campaign.errors and e is not None)
            print(f"  {turn + 1}/{campaign.repeat}  {run['user_seconds']:7.2f} s  {case.name}: "
                  f"{result}", flush=True)
            done.append(run)
            table.write_csv(folder / "results.csv", campaign, rows())
    return check_meshes(rows())


def check_meshes(rows):
    """On one mesh of degree 1 all programs have the same number of nodes."""
    for a, b in itertools.combinations([r for r in rows if r["nodes"]], 2):
        if (a["mesh"] == b["mesh"] and a["program"] != b["program"] and
                a["degree"] in ("", 1) and b["degree"] == 1 and a["nodes"] != b["nodes"]):
            b |= {"status": "failed", "reason": f"{b['nodes']} nodes instead of {a['nodes']}"}
    return rows


def report(campaign, rows, folder):
    """Write everything that is made of the rows."""
    table.write_csv(folder / "results.csv", campaign, rows)
    text = (f"# {campaign.title}\n\n{table.markdown(campaign, rows)}\n"
            f"{table.best_settings(campaign, rows)}")
    if diagrams.installed():
        for name in diagrams.draw(campaign, rows, folder):
            if name.endswith(".png"):
                text += f"\n![{name[:-4]}]({name})\n"
    else:
        print("gnuplot is not installed: no diagrams")
    (folder / "table.md").write_text(text, encoding="utf-8")
    print(f"Results in {folder}: results.csv, table.md")


def run(campaign, program, output, redraw=False, keep=False):
    """Run a campaign, or read what it has left, and report. @return its rows
    @param keep Run only what is missing in the results of an earlier time."""
    folder = output / campaign.name
    folder.mkdir(parents=True, exist_ok=True)
    print(f"{campaign.title} ({campaign.name})", flush=True)
    file = folder / "results.csv"
    earlier = table.read_csv(file) if file.exists() and (keep or redraw) else []
    if redraw:
        rows = earlier
    else:
        leave_out_missing(campaign)
        rows = run_all(campaign, program, folder, {(r["contender"], r["mesh"]): r for r in earlier})
    report(campaign, rows, folder)
    return rows
