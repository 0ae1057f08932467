# SPDX-License-Identifier: LGPL-2.1-or-later
"""Medians of repeated runs, and what is written of them: CSV, Markdown, best settings."""

import csv
import math
import statistics

# Choices that are columns of the CSV file, of any program.
CHOICES = ("degree", "element", "pairing", "normal", "geometry", "enforcement", "linearisation",
           "friction", "contact", "penalty", "increments", "sliding", "augmentation", "multiplier",
           "parts", "solver", "ranks")
FIGURES = ("nodes", "unknowns", "steps", "newton", "linear_mean")


def column_names(campaign):
    return (["campaign", "contender", "mesh", "program"] + list(CHOICES) +
            ["status", "reason"] + list(FIGURES) +
            ["runs", "user_seconds", "user_seconds_min", "user_seconds_max", "system_seconds",
             "wall_seconds", "memory_mb"] + list(campaign.columns) + list(campaign.errors))


def median_row(case, runs, campaign):
    """One row of the table from the repeated runs of a case: times are medians, results are
    those of the first run. Any run that failed makes the row one of failure."""
    failed = [run for run in runs if run["reason"]]
    chosen = failed[0] if failed else runs[0]
    row = dict.fromkeys(column_names(campaign), "")
    row |= {"campaign": campaign.name, "contender": case.line, "mesh": case.mesh,
            "program": case.program, "status": "failed" if failed else "converged",
            "reason": chosen["reason"], "runs": len(runs)}
    row |= {name: case.choices[name] for name in CHOICES if name in case.choices}
    row |= {name: chosen[name] for name in FIGURES if chosen.get(name) is not None}
    for name in ("user_seconds", "system_seconds", "wall_seconds", "memory_mb"):
        row[name] = statistics.median(run[name] for run in runs)
    row["user_seconds_min"] = min(run["user_seconds"] for run in runs)
    row["user_seconds_max"] = max(run["user_seconds"] for run in runs)
    if not failed:
        for name in campaign.errors:
            if name not in chosen["errors"] and case.program == "touchstone":
                row |= {"status": "failed", "reason": f"the run has no error '{name}'"}
            value = chosen["errors"].get(name, math.nan)
            row[name] = math.nan if value is None else value
        row |= chosen.get("columns", {})
    return row


def write_csv(path, campaign, rows):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, column_names(campaign), extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)


def read_csv(path):
    """The rows of write_csv(), with numbers where there are some."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text

    texts = ("campaign", "contender", "mesh", "program", "status", "reason")
    with open(path, encoding="utf-8", newline="") as file:
        return [{k: v if k in texts else value(v) for k, v in row.items()}
                for row in csv.DictReader(file)]


def _number(value, form):
    return format(value, form) if isinstance(value, (int, float)) and value == value else "–"


def markdown_lines(header, rows):
    """A table."""
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def markdown(campaign, rows):
    """The table for people, one row a case; a failed run shows its reason."""
    header = (["contender", "mesh", "nodes", "iterations", "CPU s", "MB"] +
              list(campaign.columns) + campaign.errors)
    body = []
    for row in rows:
        cells = [row["contender"], row["mesh"], _number(row["nodes"], ",.0f"),
                 _number(row["newton"], ".0f"), _number(row["user_seconds"], ".2f"),
                 _number(row["memory_mb"], ",.0f")]
        cells += [_number(row[name], ".5g") for name in campaign.columns]
        if row["status"] == "failed":
            cells += ["failed: " + row["reason"].replace("|", "/")]
            cells += [""] * (len(campaign.errors) - 1)
        else:
            cells += [_number(row[name], ".1e") for name in campaign.errors]
        body.append(cells)
    return markdown_lines(header, body)


def lines_of(rows):
    """Rows by contender, in the order in which they come."""
    result = {}
    for row in rows:
        result.setdefault(row["contender"], []).append(row)
    return result


def best(rows, error, tolerance):
    """The cheapest row whose @p error is within the tolerance and stays there on all finer
    meshes of its contender that have a result, for an error may pass through zero; None if
    there is none."""
    found = None
    for line in lines_of(rows).values():
        within = None
        # From the finest mesh down.
        for row in sorted(line, key=lambda r: -float(r["nodes"] or 0)):
            if row["status"] == "failed":
                continue
            if not row[error] <= tolerance:
                break
            within = row
        if within and (found is None or within["user_seconds"] < found["user_seconds"]):
            found = within
    return found


def best_settings(campaign, rows):
    """A table of the cheapest setting of each program for each error and tolerance."""
    programs = list(dict.fromkeys(row["program"] for row in rows))
    header = ["error", "within"]
    for program in programs:
        header += [f"best of {program}", "CPU s"]
    body = []
    for error in campaign.errors:
        for tolerance in campaign.tolerances:
            cells = [error, f"{100 * tolerance:g} %"]
            for program in programs:
                row = best([r for r in rows if r["program"] == program], error, tolerance)
                cells += [f"{row['contender']}, mesh {row['mesh']}",
                          _number(row["user_seconds"], ".2f")] if row else ["–", "–"]
            body.append(cells)
    return markdown_lines(header, body)
