#!/bin/sh
# inclined_patch.sh PROGRAM PROJECT FOLDER: two blocks on an interface that is inclined to all
# axes, pressed together with one uniform stress: every exact enforcement meets it to 1e-10.
set -eu
. "$(dirname -- "$0")/common.sh"

# Blocks 1 x 1 x 0.5 on each other with 6 x 6 x 2 and 4 x 4 x 2 cells, turned by the matrix of
# the unit quaternion (1, 0.3, -0.4, 0.2), and the displacement 0.01 z towards the interface.
awk -v mesh=inclined.msh -v scene=inclined.prm '
function rotate(x, y, z) {
  px = r[1,1] * x + r[1,2] * y + r[1,3] * z
  py = r[2,1] * x + r[2,2] * y + r[2,3] * z
  pz = r[3,1] * x + r[3,2] * y + r[3,3] * z
}
function node(b, i, j, k) { return start[b] + i + (n[b] + 1) * (j + (n[b] + 1) * k) }
BEGIN {
  OFMT = CONVFMT = "%.17g"
  a = 1; b = 0.3; c = -0.4; d = 0.2; s = sqrt(a * a + b * b + c * c + d * d)
  a /= s; b /= s; c /= s; d /= s
  r[1,1] = a*a+b*b-c*c-d*d; r[1,2] = 2*(b*c-a*d); r[1,3] = 2*(b*d+a*c)
  r[2,1] = 2*(b*c+a*d); r[2,2] = a*a-b*b+c*c-d*d; r[2,3] = 2*(c*d-a*b)
  r[3,1] = 2*(b*d-a*c); r[3,2] = 2*(c*d+a*b); r[3,3] = a*a-b*b-c*c+d*d
  n[1] = 6; n[2] = 4; start[1] = 1; start[2] = 1 + 49 * 3
  print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n6" >mesh
  print "3 1 \"lower\"\n3 2 \"upper\"\n2 11 \"lower_end\"\n2 12 \"lower_face\"" >mesh
  print "2 21 \"upper_face\"\n2 22 \"upper_end\"\n$EndPhysicalNames" >mesh
  print "$Nodes\n" 49 * 3 + 25 * 3 >mesh
  for (q = 1; q <= 2; ++q)
    for (k = 0; k <= 2; ++k)
      for (j = 0; j <= n[q]; ++j)
        for (i = 0; i <= n[q]; ++i) {
          rotate(i / n[q], j / n[q], 0.5 * (q - 1) + 0.25 * k)
          print node(q, i, j, k), px, py, pz >mesh
        }
  print "$EndNodes\n$Elements\n" (36 + 16) * 4 >mesh
  e = 0
  for (q = 1; q <= 2; ++q)
    for (j = 0; j < n[q]; ++j)
      for (i = 0; i < n[q]; ++i) {
        for (k = 0; k < 2; ++k)
          print ++e, 5, 2, q, q, node(q, i, j, k), node(q, i+1, j, k), node(q, i+1, j+1, k), node(q, i, j+1, k), node(q, i, j, k+1), node(q, i+1, j, k+1), node(q, i+1, j+1, k+1), node(q, i, j+1, k+1) >mesh
        for (k = 0; k <= 2; k += 2)
          print ++e, 3, 2, q * 10 + 1 + k / 2, q * 10 + 1 + k / 2, node(q, i, j, k), node(q, i+1, j, k), node(q, i+1, j+1, k), node(q, i, j+1, k) >mesh
      }
  print "$EndElements" >mesh
  print "set Bodies = lower, upper\nset Contact pairs = interface" >scene
  for (q = 1; q <= 2; ++q) {
    name = q == 1 ? "lower" : "upper"
    print "subsection Body " name >scene
    print q == 1 ? "  set Fixed = lower_end" : "  set Boundary conditions = upper_end" >scene
    print "  subsection Geometry\n    set Type = file\n    set File = inclined.msh" >scene
    print "    set Volume = " name "\n  end" >scene
    print "  subsection Material\n    set Young modulus = 1000\n    set Poisson ratio = 0\n  end" >scene
    if (q == 2)
      print "  subsection Boundary upper_end\n    set Displacement x = " (-0.01 * r[1,3]) " * t\n    set Displacement y = " (-0.01 * r[2,3]) " * t\n    set Displacement z = " (-0.01 * r[3,3]) " * t\n  end" >scene
    print "end" >scene
  }
  print "subsection Contact pair interface\n  set Slave body = lower\n  set Slave boundaries = lower_face" >scene
  print "  set Master body = upper\n  set Master boundaries = upper_face\nend" >scene
  p = -10
  print "subsection Reference solution\n  set Type = uniform stress\n  set Pair = interface" >scene
  print "  set Values = pressure: 10, sxx: " p*r[1,3]*r[1,3] ", syy: " p*r[2,3]*r[2,3] ", szz: " p*r[3,3]*r[3,3] ", sxy: " p*r[1,3]*r[2,3] ", sxz: " p*r[1,3]*r[3,3] ", syz: " p*r[2,3]*r[3,3] "\nend" >scene
}'

# The augmented Lagrangian stops at the gap tolerance.
set -- --set "Newton/Residual tolerance=1e-12" --set "Newton/Gap tolerance=1e-12"
for role in fine coarse; do
  for enforcement in elimination "lagrange multipliers" "augmented lagrange"; do
    name="${role}_$(echo "$enforcement" | tr ' ' _)"
    run "$name" 1 inclined.prm "$@" --set "Contact/Enforcement=$enforcement"
    below "$name" stress_max_deviation "$(value "$name" /errors/stress_max_deviation)" 1e-10
  done
  pair="Contact pair interface"
  set -- "$@" --set "$pair/Slave body=upper" --set "$pair/Slave boundaries=upper_face" \
    --set "$pair/Master body=lower" --set "$pair/Master boundaries=lower_face"
done

finish
