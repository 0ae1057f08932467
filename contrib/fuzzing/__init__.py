# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes and inputs that nobody planned, and what must hold for each of them.

    geometry, round_geometry   the built-in geometries, rotated, mirrored, rescaled
    scene, text                a scene, its transformations, its text
    stacks, fits               random scenes of one kind each
    parts, materials, motions  what they are made of
    generator                  the random choice between them
    runs, vtu                  a run of the program, and what it wrote
    invariants                 what must hold within one run
    agreement                  what must hold between runs of the same scene
    campaign                   variants of a scene, verdicts and their table
    shrink                     the simplest scene with the same finding
    mutations, answers         inputs with one fault, and how the program answers
"""
