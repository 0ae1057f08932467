#!/bin/sh
# warnings.sh PROGRAM PROJECT FOLDER: what the user should know of results is told in the log
# and in summary.json; a run whose mesh file has changed is not resumed.
set -eu
. "$(dirname -- "$0")/common.sh"

cat >lift_off.prm <<END
set Bodies        = base, block
set Contact pairs = contact, never
subsection Body base
  set Fixed = bottom
  subsection Geometry
    set Type         = box
    set Lower corner = -1, -1, -1
    set Upper corner = 2, 2, 0
    set Cells        = 3, 3, 1
  end
  subsection Material
    set Young modulus = 1000
  end
end
subsection Body block
  set Boundary conditions = top
  subsection Geometry
    set Type  = box
    set Cells = 2, 2, 2
  end
  subsection Material
    set Young modulus = 1000
  end
  subsection Boundary top
    set Displacement x = 0
    set Displacement y = 0
    set Displacement z = 0.02 * (t - 0.4)
  end
end
subsection Contact pair contact
  set Slave body        = block
  set Slave boundaries  = bottom
  set Master body       = base
  set Master boundaries = top
end
subsection Contact pair never
  set Slave body        = block
  set Slave boundaries  = left
  set Master body       = base
  set Master boundaries = right
end
subsection Load stepping
  set Steps = 4
end
END
run lift_off 1 lift_off.prm
text="contact pair 'contact' had contact until t = 0.25 and has none at the end"
grep -qF "$text" lift_off/log || fail "no warning in the log"
grep -qF "$text" lift_off/summary.json || fail "no warning in summary.json"

# The mesh of a body is another one when the run is to go on.
mkdir -p mesh
cp "$source/tests/meshes/two_blocks_v2.msh" mesh/blocks.msh
cat >mesh/scene.prm <<END
set Bodies = block
subsection Body block
  set Boundary conditions = lid
  set Fixed               = base
  subsection Geometry
    set Type = file
    set File = blocks.msh
  end
  subsection Material
    set Young modulus = 1000
  end
  subsection Boundary lid
    set Displacement z = -0.01*t
  end
end
subsection Load stepping
  set Steps = 2
end
subsection Checkpoints
  set Steps between = 1
end
END
run written 1 mesh/scene.prm
rm -r written/checkpoint_000002
sed 's/^27 1 1 2$/27 1 1.01 2/' mesh/blocks.msh >mesh/moved.msh
cmp -s mesh/blocks.msh mesh/moved.msh && fail "the mesh is not changed"
mv mesh/moved.msh mesh/blocks.msh
if "$program" --results-only --resume --output written mesh/scene.prm >resumed.txt 2>&1; then
  fail "resumed with another mesh"
fi
grep -q "section 'Body block/Geometry', key 'File': the mesh file is not the one" resumed.txt ||
  { fail "another message"; cat resumed.txt; }
finish
