# SPDX-License-Identifier: LGPL-2.1-or-later
# ctest: label = quick
"""Sets of nodes of mesh files: supports and forces on edges and points, Abaqus, Gmsh and VTK. Reactions of a
block that three points hold, and of a beam on two edges, follow from statics, whatever the element, the
refinement, the solver and the ranks; a force on an edge is the same per length on cells of different length;
momentum in explicit dynamics; what needs faces is refused."""

import itertools
import pathlib
import struct

from touchstone_test import CG, DEGREE, FACTOR, below, check, finish, folder, launch, relative, run

X, Y, Z = (0, 0.5, 1.5, 3, 4), (0, 0.4, 1), (0, 0.5, 1)
NODES = {(i, j, k): 1 + i + len(X) * (j + len(Y) * k)
         for k, j, i in itertools.product(range(3), range(3), range(5))}
AROUND = (0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)
CELLS = [[NODES[i + a, j + b, k + c] for a, b, c in AROUND]
         for k, j, i in itertools.product(range(2), range(2), range(4))]
EDGES = {"left": [(0, j, 0) for j in range(3)], "right": [(4, j, 0) for j in range(3)],
         "top": [(i, 0, 2) for i in range(5)]}
POINTS = {"one": [(0, 0, 0)], "two": [(4, 0, 0)], "three": [(0, 2, 0)], "tips": [(4, 0, 2), (4, 2, 2)]}


def abaqus():
    """The mesh with NSETs."""
    lines = ["*NODE"]
    lines += [f"{n}, {X[i]}, {Y[j]}, {Z[k]}" for (i, j, k), n in NODES.items()]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=beam"]
    lines += [", ".join(map(str, [c + 1, *cell])) for c, cell in enumerate(CELLS)]
    for name, members in {**EDGES, **POINTS}.items():
        lines += [f"*NSET, NSET={name}", ", ".join(str(NODES[m]) for m in members)]
    lines += ["*NSET, NSET=again", "left, top", "*NSET, NSET=run, GENERATE", "1, 5, 1",
              "*ELSET, ELSET=at west", *(str(1 + 4 * n) for n in range(4)),
              "*SURFACE, NAME=west", "at west, S6",
              "*ELSET, ELSET=at east", *(str(4 + 4 * n) for n in range(4)), "*SURFACE, NAME=east", "at east, S4"]
    return "\n".join(lines) + "\n"


def gmsh():
    """The same with physical curves and points."""
    names, elements = [], []
    for number, name in enumerate(EDGES, 1):
        names.append(f'1 {number} "{name}"')
        for a, b in zip(EDGES[name], EDGES[name][1:]):
            elements.append(f"1 2 {number} {number} {NODES[a]} {NODES[b]}")
    for number, name in enumerate(POINTS, 1):
        names.append(f'0 {number} "{name}"')
        elements += [f"15 2 {number} {number} {NODES[m]}" for m in POINTS[name]]
    names.append('3 1 "beam"')
    elements += [f"5 2 1 1 {' '.join(map(str, cell))}" for cell in CELLS]
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names,
                      "$EndPhysicalNames", "$Nodes", str(len(NODES)),
                      *(f"{n} {X[i]} {Y[j]} {Z[k]}" for (i, j, k), n in NODES.items()), "$EndNodes",
                      "$Elements", str(len(elements)), *(f"{n} {e}" for n, e in enumerate(elements, 1)),
                      "$EndElements"]) + "\n"


def gmsh_partitioned(partitions=2):
    """The same in binary of version 4.1 and divided in two: elements belong to parts of entities that the
    section of partitioned entities has, those of the cells without groups of their own."""
    def i(*values):
        return struct.pack(f"<{len(values)}i", *values)

    def n(*values):
        return struct.pack(f"<{len(values)}Q", *values)

    def x(*values):
        return struct.pack(f"<{len(values)}d", *values)

    def section(name, *parts):
        return f"${name}\n".encode() + b"".join(parts) + f"\n$End{name}\n".encode()

    half = len(CELLS) // 2
    # By dimension: number and group of an entity, its elements, and the entity that it is a part of.
    blocks = [(0, number, number, [[NODES[m]] for m in POINTS[name]], number) for number, name in enumerate(POINTS, 1)]
    blocks += [(1, number, number, [[NODES[a], NODES[b]] for a, b in zip(EDGES[name], EDGES[name][1:])], number)
               for number, name in enumerate(EDGES, 1)]
    blocks += [(3, 11, None, CELLS[:half], 1), (3, 12, None, CELLS[half:], 1)]
    counts = [sum(block[0] == d for block in blocks) for d in range(4)]
    parts = [i(number, d, whole) + n(1) + i(number % 2 + 1) + x(*[0] * (6 if d else 3))
             + (n(1) + i(group) if group else n(0)) + (n(0) if d else b"")
             for d, number, group, _, whole in blocks]
    numbers = itertools.count(1)
    elements = [i(d, number, (15, 1, None, 5)[d]) + n(len(members))
                + b"".join(n(next(numbers), *member) for member in members) for d, number, _, members, _ in blocks]
    names = [f'1 {k} "{name}"' for k, name in enumerate(EDGES, 1)] + [f'0 {k} "{name}"' for k, name in enumerate(POINTS, 1)]
    return b"".join([
        b"$MeshFormat\n4.1 1 8\n", i(1), b"\n$EndMeshFormat\n",
        "\n".join(["$PhysicalNames", str(len(names) + 1), *names, '3 1 "beam"', "$EndPhysicalNames", ""]).encode(),
        section("Entities", n(0, 0, 0, 1), i(1), x(*[0] * 6), n(1), i(1), n(0)),
        section("PartitionedEntities", n(partitions, 0, *counts), *parts),
        section("Nodes", n(1, len(NODES), 1, len(NODES)), i(3, 11, 0), n(len(NODES), *NODES.values()),
                *(x(X[a], Y[b], Z[c]) for a, b, c in NODES)),
        section("Elements", n(len(blocks), sum(len(b[3]) for b in blocks), 1, len(NODES)), *elements)])


def vtu():
    """The same with an array of the points for each set."""
    def array(kind, name, values, components=1):
        return (f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
                f'{" ".join(map(str, values))}</DataArray>')

    marks = [array("Int32", name, [int(place in members) for place in NODES])
             for name, members in {**EDGES, **POINTS}.items()]
    return "\n".join([
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">', "<UnstructuredGrid>",
        f'<Piece NumberOfPoints="{len(NODES)}" NumberOfCells="{len(CELLS)}">', "<PointData>", *marks, "</PointData>",
        "<Points>", array("Float64", "Points", (x for i, j, k in NODES for x in (X[i], Y[j], Z[k])), 3), "</Points>",
        "<Cells>", array("Int32", "connectivity", (n - 1 for cell in CELLS for n in cell)),
        array("Int32", "offsets", range(8, 8 * len(CELLS) + 1, 8)), array("UInt8", "types", [12] * len(CELLS)),
        "</Cells>", "</Piece>", "</UnstructuredGrid>", "</VTKFile>"]) + "\n"


def vtk():
    """The same in the legacy format: sets as scalars and, as ParaView writes them, as fields, and an end of
    the beam as cells of the file."""
    end = [[NODES[4, j + a, k + b] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))] for k in range(2) for j in range(2)]
    cells = CELLS + end
    marks = {name: "\n".join(str(int(place in members)) for place in NODES) for name, members in {**EDGES, **POINTS}.items()}
    return "\n".join([
        "# vtk DataFile Version 3.0", "beam", "ASCII", "DATASET UNSTRUCTURED_GRID",
        f"POINTS {len(NODES)} double", *(f"{X[i]} {Y[j]} {Z[k]}" for i, j, k in NODES),
        f"CELLS {len(cells)} {sum(map(len, cells)) + len(cells)}",
        *(" ".join(map(str, [len(cell), *(n - 1 for n in cell)])) for cell in cells),
        f"CELL_TYPES {len(cells)}", *("12" for cell in CELLS), *("9" for cell in end),
        f"POINT_DATA {len(NODES)}",
        *(f"SCALARS {name} int 1\nLOOKUP_TABLE default\n{marks[name]}" for name in EDGES),
        f"FIELD FieldData {len(POINTS) + 1}", f"motion 3 {len(NODES)} float", *("0 0 nan" for place in NODES),
        *(f"{name} 1 {len(NODES)} int\n{marks[name]}\nMETADATA\nINFORMATION 0\n" for name in POINTS),
        f"CELL_DATA {len(cells)}", "FIELD FieldData 1", f"end 1 {len(cells)} int",
        *("0" for cell in CELLS), *("1" for cell in end)]) + "\n"


pathlib.Path(folder / "beam.inp").write_text(abaqus(), encoding="utf-8")
pathlib.Path(folder / "beam.msh").write_text(gmsh(), encoding="utf-8")
pathlib.Path(folder / "beam.vtu").write_text(vtu(), encoding="utf-8")
pathlib.Path(folder / "beam.vtk").write_text(vtk(), encoding="utf-8")
(folder / "parts.msh").write_bytes(gmsh_partitioned())
(folder / "part.msh").write_bytes(gmsh_partitioned(partitions=3))
ARRAYS = f"\n    set Boundary arrays = {', '.join([*EDGES, *POINTS])}"
HEAD = """set Title  = Sets of nodes
set Bodies = beam
subsection Body beam
  subsection Geometry
    set Type = file
    set File = {file}
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density       = 1
  end
"""
TAIL = """end
subsection Load stepping
  set Steps = 1
end
subsection Output
  set VTU interval = 0
end
"""


def scene(name, file, *lines):
    """A scene with these lines in the body."""
    path = folder / f"{name}.prm"
    arrays = {".vtu": ARRAYS, ".vtk": ARRAYS + ", end"}.get(pathlib.Path(file).suffix, "")
    path.write_text(HEAD.format(file=file + arrays) + "\n".join(lines) + "\n" + TAIL, encoding="utf-8")
    return path


def boundary(name, *entries):
    return [f"  subsection Boundary {name}", *(f"    set {entry}" for entry in entries), "  end"]


# On two edges, with a force on a third one.
BEAM = ["  set Boundary conditions = left, right, top, one",
        *boundary("left", "Displacement z = 0", "Displacement x = 0"), *boundary("right", "Displacement z = 0"),
        *boundary("one", "Displacement y = 0"), *boundary("top", "Force z = -2*t")]
bent = {name: scene(f"beam_{name}", f"beam.{name}", *BEAM) for name in ("inp", "msh", "vtu", "vtk")}
bent["parts"] = scene("beam_parts", "parts.msh\n    set Volume = beam", *BEAM)
for name, file, settings, ranks in (("inp", "inp", {}, 1), ("msh", "msh", {}, 1), ("vtu", "vtu", {}, 1), ("vtk", "vtk", {}, 1), ("parts", "parts", {}, 1), ("ranks", "inp", {}, 2),
                                    ("fine", "inp", {FACTOR: 2}, 2), ("degree", "msh", {DEGREE: 2}, 1),
                                    ("both", "msh", {DEGREE: 2, FACTOR: 2}, 2), ("cg", "inp", CG, 1),
                                    ("adaptive", "inp", {"Refinement/Estimator": "recovered stress",
                                                          "Refinement/Cycles": 2}, 1),
                                    ("p4est", "inp", {FACTOR: 2, "Discretisation/Partitioner": "p4est"}, 2)):
    result = run(name, bent[file], settings, ranks)
    for edge in "left", "right":
        below(f"{name}: reaction at {edge}", relative(result.reaction("beam", edge)[2], 1), 1e-7)
    below(f"{name}: no other reaction", max(abs(r) for r in (*result.reaction("beam", "left")[:2],
                                                            *result.reaction("beam", "one"))), 1e-7)

# What the program has understood.
for name, ranks in ("inp", 1), ("inp", 2), ("msh", 1):
    understood = launch("--validate", bent[name], ranks=ranks).stdout
    for line in "left: 3 nodes, x 0 to 0, y 0 to 1, z 0 to 0", "tips: 2 nodes, x 4 to 4, y 0 to 1, z 1 to 1":
        check(f"set of nodes {line}" in understood, f"validate {name}: no '{line}' in {understood}")

# Three points hold the block, forces at its tips: statics alone decides.
points = scene("points", "beam.inp", "  set Fixed = one", "  set Boundary conditions = two, three, tips",
               *boundary("two", "Displacement y = 0", "Displacement z = 0"), *boundary("three", "Displacement z = 0"),
               *boundary("tips", "Force z = -3*t"))
for name, settings, ranks in ("points", {}, 1), ("points_fine", {FACTOR: 2}, 2), ("points_2", {DEGREE: 2}, 1):
    result = run(name, points, settings, ranks)
    # The resultant -3 at (4, 0.5): the third point at (0, 1) has 1.5, the first one -1.5, the second 3.
    for point, force in (("one", -1.5), ("two", 3), ("three", 1.5)):
        below(f"{name}: reaction at {point}", relative(result.reaction("beam", point)[2], force), 1e-7)

# Momentum of a free beam is force times time, with its moment about the origin: the edge is at y = 0, its
# middle at x = 2.
free = scene("free", "beam.inp", "  set Boundary conditions = top", *boundary("top", "Force z = 2"))
for name, settings, ranks in (("explicit", {"Time integration/Scheme": "central_differences"}, 1),
                              ("explicit_2", {"Time integration/Scheme": "central_differences"}, 2),
                              ("newmark", {"Time integration/Scheme": "newmark"}, 2)):
    moved = run(name, free, {**settings, "Load stepping/End time": 0.01, "Load stepping/Steps": 4}, ranks)
    last = moved.rows()[-1]
    # Explicit velocities are half a cycle early.
    below(f"{name}: momentum", relative(last["momentum z"], 2 * (0.01 - last.get("shortest cycle", 0) / 2)), 1e-9)
    below(f"{name}: its moment", relative(last["angular momentum y"] / last["momentum z"], -2), 1e-4)

# What needs faces, and names that are none.
for name, entries, text in (("pressure", ["Pressure = 1"], "needs faces, but this is a set of nodes"),
                            ("moment", ["Moment x = 1"], "needs faces, but this is a set of nodes")):
    bad = scene(f"bad_{name}", "beam.inp", "  set Fixed = left, two", "  set Boundary conditions = top",
                *boundary("top", *entries))
    refused = run(f"bad_{name}", bad, fails=True)
    check(text in refused.text, f"{name}: {refused.text[-500:]}")
# A boundary by an array of the cells of a .vtk file, and arrays that are damaged or not there.
pulled = run("pulled", scene("pulled", "beam.vtk", "  set Fixed = left, right", "  set Boundary conditions = end",
                             *boundary("end", "Traction x = 3*t")))
below("traction on the cells of an array", relative(sum(pulled.reaction("beam", edge)[0] for edge in ("left", "right")), -3), 1e-7)
whole = vtk()
for name, old, new, text in (("number", "POINT_DATA 45", "POINT_DATA 44", "POINT_DATA announces 44 points, POINTS 45"),
                             ("name", "end 1 20 int", "End 1 20 int", "has no array 'end' of one component"),
                             ("short", "end 1 20 int\n0", "end 1 20 int", "FIELD")):
    check(whole.count(old) == 1, f"{name}: the file has no '{old}'")
    (folder / f"bad_{name}.vtk").write_text(whole.replace(old, new), encoding="utf-8")
    refused = run(f"bad_{name}", scene(f"bad_vtk_{name}", f"bad_{name}.vtk", "  set Fixed = left"), fails=True)
    check(text in refused.text, f"{name}: {refused.text[-500:]}")
partial = run("bad_part", scene("bad_part", "part.msh", "  set Fixed = left"), fails=True)
check("divided into 3 partitions, of which the file has 2" in partial.text, partial.text[-500:])
misspelt = run("bad_set", scene("bad_set", "beam.msh", "  set Fixed = lfet"), fails=True)
check("and the sets of nodes 'left', 'one'" in misspelt.text, misspelt.text[-500:])
symmetric = run("bad_symmetry", scene("bad_symmetry", "beam.inp", "  set Symmetry = left"), fails=True)
check("is a set of nodes, but faces are needed here" in symmetric.text, symmetric.text[-500:])
finish()
