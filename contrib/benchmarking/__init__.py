# SPDX-License-Identifier: LGPL-2.1-or-later
"""The benchmark harness behind contrib/benchmark; doc/benchmarks.md says how it is used.

campaign   reads a campaign file and makes the list of runs
processes  runs a program and says what it used
touchstone runs this program and reads its summary
calculix   the same for CalculiX: deck, run, results
surfaces   areas of slave nodes, which CalculiX does not give
measures   errors against exact solutions, as the program itself computes them
table      medians, CSV, Markdown, best settings
diagrams   work-precision diagrams with gnuplot
"""
