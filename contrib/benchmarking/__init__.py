# SPDX-License-Identifier: LGPL-2.1-or-later
"""The benchmark harness behind contrib/benchmark; doc/benchmarks.md says how it is used.

choices    what a contender can choose
campaign   reads a campaign file and makes the list of runs
processes  runs a program and says what it used
touchstone runs this program and reads its summary
exported   the discrete problem that other programs are given
calculix   the same for CalculiX: deck and run; calculix_results reads its answers
with_getfem     the same for GetFEM; getfem_program, getfem_bodies and getfem_contact are its program
surfaces   areas of slave nodes, which CalculiX does not give
fields     tractions as fields, and their distance from exact ones
measures   errors against exact solutions, as the program itself computes them
runner     all runs of a campaign
scoreboard the page of contrib/scoreboard
table      medians, CSV, Markdown, best settings
diagrams   work-precision diagrams with gnuplot
"""
