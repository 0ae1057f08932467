# SPDX-License-Identifier: LGPL-2.1-or-later
"""Small scenes of what the shipped ones lack: laws, shapes, and formats of mesh files."""

import base64
import itertools
import struct

_SCENE = """set Bodies = block
{lists}
subsection Body block
  set Fixed               = {base}
  set Boundary conditions = {lid}
  subsection Geometry
{geometry}
  end
  subsection Material
{material}
  end
  subsection Boundary {lid}
    set {condition}
  end
end
{rest}
subsection Load stepping
  set Phases = press, hold
  subsection Phase press
    set End time = 1
    set Steps    = 2
  end
  subsection Phase hold
    set End time = 2
  end
end
"""

_BOX = """    set Type  = box
    set Cells = 2, 2, 2"""

_PRESSED = "Displacement z = -0.01*min(t, 1)"

_LAWS = {
    "gent": """set Law = Gent
set Shear modulus    = 10
set Locking stretch  = 3
set Poisson ratio    = 0.4""",
    "ogden": """set Law = Ogden
set Moduli        = 6.3, 0.012, -0.1
set Exponents     = 1.3, 5, -2
set Poisson ratio = 0.45""",
    "mooney_rivlin": """set Law = Mooney-Rivlin
set C10           = 3
set C01           = 1
set Poisson ratio = 0.45""",
    "orthotropic": """set Law = orthotropic
set Young moduli     = 100, 50, 20
set Poisson ratios   = 0.3, 0.2, 0.1
set Shear moduli     = 30, 20, 10
set First direction  = 1, 1, 0
set Second direction = 0, 0, 1""",
    "viscoelastic": """set Law = viscoelastic
set Young modulus    = 100
set Relaxation times = 0.1, 1
set Shear ratios     = 0.2, 0.3""",
    "thermal": """set Young modulus = 100
subsection Thermal expansion
  set Coefficient = 1e-5
  set Temperature = 20*t*x
end""",
}

_SHAPES = {
    "torus": """set Shape        = torus
set Centre       = 0.5, 0.5, 1.3
set Direction    = 0, 0, 1
set Radius       = 0.5
set Tube radius  = 0.3
set Motion z     = -0.01*min(t, 1)
set Rotate point = 0.5, 0.5, 0
set Rotate angle = 5*t""",
    "cone": """set Shape      = cone
set Tip        = 0.5, 0.5, 1
set Direction  = 0, 0, 1
set Half angle = 70
set Tip radius = 0.4
set Motion z   = -0.01*min(t, 1)""",
}


def _indented(text, by):
    return "\n".join(" " * by + line for line in text.split("\n"))


def _scene(material="set Young modulus = 100", geometry=_BOX, base="bottom", lid="top",
           condition=_PRESSED, lists="", rest=""):
    return _SCENE.format(material=_indented(material, 4), geometry=geometry, base=base, lid=lid,
                         condition=condition, lists=lists, rest=rest)


def _with_obstacle(shape):
    return _scene(condition="Spring stiffness normal = 1",
                  lists="set Obstacles = tool\nset Contact pairs = contact",
                  rest=f"""subsection Obstacle tool
{_indented(shape, 2)}
end
subsection Contact pair contact
  set Slave body       = block
  set Slave boundaries = top
  set Obstacle         = tool
  set Behaviour        = coulomb
  subsection Friction
    set Coefficient = 0.2
  end
end""")


def _grid(n=2):
    """Points of a cube, its cells in the order of the file formats, and faces below and above."""
    points = [(x / n, y / n, z / n) for z, y, x in itertools.product(range(n + 1), repeat=3)]

    def at(x, y, z):
        return x + (n + 1) * (y + (n + 1) * z)

    def square(x, y, z):
        return [at(x, y, z), at(x + 1, y, z), at(x + 1, y + 1, z), at(x, y + 1, z)]
    cells = [square(x, y, z) + square(x, y, z + 1)
             for z, y, x in itertools.product(range(n), repeat=3)]
    return points, cells, [[square(x, y, z) for y, x in itertools.product(range(n), repeat=2)]
                           for z in (0, n)]


def gmsh_binary():
    """Version 4.1: text between the numbers of sections, which are bytes."""
    points, cells, sides = _grid()
    result = b"$MeshFormat\n4.1 1 8\n" + struct.pack("<i", 1) + b"\n$EndMeshFormat\n"
    result += b'$PhysicalNames\n2\n2 1 "base"\n2 2 "lid"\n$EndPhysicalNames\n'
    box = struct.pack("<6d", 0, 0, 0, 1, 1, 1)
    result += b"$Entities\n" + struct.pack("<4Q", 0, 0, 2, 1)
    for tag in (1, 2):
        result += struct.pack("<i", tag) + box + struct.pack("<QiQ", 1, tag, 0)
    result += struct.pack("<i", 1) + box + struct.pack("<QQ", 0, 0) + b"\n$EndEntities\n"
    n = len(points)
    result += b"$Nodes\n" + struct.pack("<4Q", 1, n, 1, n) + struct.pack("<3iQ", 3, 1, 0, n)
    result += struct.pack(f"<{n}Q", *range(1, n + 1))
    result += b"".join(struct.pack("<3d", *x) for x in points) + b"\n$EndNodes\n$Elements\n"
    blocks = [(2, 1, 3, sides[0]), (2, 2, 3, sides[1]), (3, 1, 5, cells)]
    total = sum(len(block[3]) for block in blocks)
    result += struct.pack("<4Q", len(blocks), total, 1, total)
    number = itertools.count(1)
    for dim, tag, kind, elements in blocks:
        result += struct.pack("<3iQ", dim, tag, kind, len(elements))
        for nodes in elements:
            result += struct.pack(f"<{len(nodes) + 1}Q", next(number), *(k + 1 for k in nodes))
    return result + b"\n$EndElements\n"


def vtu(encoding):
    """Quadrilaterals with the numbers 1 and 2 below and above; arrays in "ascii" or "binary"."""
    points, cells, sides = _grid()
    all_cells = cells + sides[0] + sides[1]
    numbers = [0] * len(cells) + [1] * len(sides[0]) + [2] * len(sides[1])

    def array(name, kind, values):
        code = {"Float64": "d", "Int64": "q"}[kind]
        data = struct.pack(f"<{len(values)}{code}", *values)
        text = (" ".join(map(str, values)) if encoding == "ascii" else
                base64.b64encode(struct.pack("<Q", len(data)) + data).decode())
        components = ' NumberOfComponents="3"' if name == "Points" else ""
        return (f'<DataArray type="{kind}" Name="{name}"{components} format="{encoding}">\n{text}\n'
                "</DataArray>\n")
    return (f"""<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<UnstructuredGrid>
<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(all_cells)}">
<Points>
{array("Points", "Float64", [c for x in points for c in x])}</Points>
<Cells>
{array("connectivity", "Int64", [k for cell in all_cells for k in cell])}"""
            f"""{array("offsets", "Int64", list(itertools.accumulate(map(len, all_cells))))}"""
            f"""{array("types", "Int64", [12 if len(cell) == 8 else 9 for cell in all_cells])}"""
            f"""</Cells>
<CellData>
{array("MaterialID", "Int64", numbers)}</CellData>
</Piece>
</UnstructuredGrid>
</VTKFile>
""").encode()


def _from_file(name, base, lid):
    return _scene(geometry=f"    set Type = file\n    set File = {name}", base=base, lid=lid)


def scenes():
    """Names, texts, and the mesh file of each with its name; None if it has none."""
    result = [(f"{name}.prm", _scene(law), None) for name, law in _LAWS.items()]
    result += [(f"{name}.prm", _with_obstacle(shape), None) for name, shape in _SHAPES.items()]
    for name, data, base, lid in (("binary.msh", gmsh_binary(), "base", "lid"),
                                  ("ascii.vtu", vtu("ascii"), "1", "2"),
                                  ("base64.vtu", vtu("binary"), "1", "2")):
        result.append((f"{name}.prm", _from_file(name, base, lid), (name, data)))
    return result
