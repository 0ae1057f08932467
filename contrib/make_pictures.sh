#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Run the scenes of the documentation and make its pictures, doc/pictures/*.png.
# Needs VTK, an X server and gnuplot:
#   apt-get install python3-vtk9 python3-numpy xvfb xauth gnuplot-nox
#
# Usage: contrib/make_pictures.sh [PROGRAM [NAME...]]      (build/touchstone, all)
#
# NAME is that of a picture of a scene (press_fit, twist, ...) or of a test, or ironing_forces, partial_slip,
# bar_impact, plate_drop_energies. Runs are kept in $TOUCHSTONE_RUNS (output/pictures) and not
# repeated; plate_drop takes minutes, ironing ten.
set -eu
# One display for all pictures; its server needs a moment to start.
[ -n "${DISPLAY-}" ] || exec xvfb-run -n $((100 + $$ % 900)) -w 5 sh "$0" "$@"
cd "$(dirname -- "$0")/.."
program=${1:-build/touchstone}
[ $# -eq 0 ] || shift
wanted=$*
runs=${TOUCHSTONE_RUNS:-output/pictures}
pictures=doc/pictures
mkdir -p "$runs" "$pictures"
export OPENBLAS_NUM_THREADS=1

# wants NAME: whether this picture is asked for.
wants()
{
  [ -z "$wanted" ] && return 0
  case " $wanted " in *" $1 "*) return 0 ;; esac
  return 1
}

# run SCENE [OPTION...]: once.
run()
{
  scene=$1
  shift
  mkdir -p "$(dirname "$runs/$scene")"
  [ -f "$runs/$scene/summary.json" ] ||
    "$program" --output "$runs/$scene" "$@" "prm/$scene.prm" >"$runs/$scene.log"
}

# render_test NAME OPTION...: the same of a scene of tests/ or of its folders.
render_test()
{
  name=${1##*/}
  wants "$name" || return 0
  scene=$1
  shift
  mkdir -p "$runs/tests"
  [ -f "$runs/tests/$name/summary.json" ] ||
    "$program" --output "$runs/tests/$name" --set "Output/VTU interval=1" "tests/$scene.prm" >"$runs/tests/$name.log"
  /usr/bin/python3 contrib/render.py "$runs/tests/$name" "$pictures/$name.png" --unit MPa "$@"
}

# render SCENE OPTION...: run it and make a picture with contrib/render.py.
render()
{
  name=${1##*/}
  wants "$name" || return 0
  run "$1"
  folder=$runs/$1
  shift
  /usr/bin/python3 contrib/render.py "$folder" "$pictures/$name.png" --unit MPa "$@"
}

small="520 400"
render press_fit --camera "0.35 -0.6 1" --up "0 1 0" --contact-camera "-1 -1 0.7" --contact-up "0 0 1"
render two_tubes --camera "0.5 0.75 0.9" --up "0 1 0" --contact-camera "0.5 -0.6 -0.6" --contact-up "0 1 0"
render imported_mesh --size "$small" --camera "0.35 -0.6 1" --up "0 1 0" --contact-camera "-1 -1 0.7" \
  --contact-up "0 0 1"
render patch_test --size "$small" --camera "1 -1.4 0.7" --contact-camera "0.6 -1 1.2"
render hertz_sphere --camera "-1 -0.6 0.35" --focus "0.1 0.1 -0.02" --width 0.9 \
  --contact-camera "-0.4 -0.8 1.6" --contact-width 0.55 --points "$runs/hertz_sphere.txt"
render hertz_rigid_plane --size "$small" --camera "-1 -0.6 0.35" --focus "0.1 0.1 0.1" --width 0.9 \
  --contact-camera "-0.4 -0.8 1.6" --contact-width 0.55
render hertz_sphere_adaptive --camera "-1 -0.6 0.35" --focus "0.1 0.1 -0.02" --width 0.9 \
  --contact-camera "-0.4 -0.8 1.6" --contact-width 0.55 --no-outline
render plate_drop --field equivalent_plastic_strain --unit "" --contact-unit MPa --camera "0 -1 0.2" \
  --focus "0 0 0.08" --width 0.36 --contact-camera "0 -0.3 -1" --contact-width 0.2
render benchmarks/cattaneo_mindlin --size "$small" --camera "0.3 -1 0.25" --focus "0 0 0" --width 4 \
  --contact traction_x --contact-camera "0 0 1" --contact-up "0 1 0" --contact-width 2.6
render benchmarks/cook --size "$small" --no-contact --camera "0.15 0.1 1" --up "0 1 0"
render benchmarks/hill_tube --size "$small" --field equivalent_plastic_strain --unit "" --contact-unit MPa \
  --camera "0.35 -0.6 1" --up "0 1 0" --no-contact
render lug --size "$small" --camera "0.3 -0.6 1" --up "0 1 0" --contact-camera "0.5 -1 0.6" --contact-up "0 0 1" --no-edges
render seal --size "$small" --camera "0.3 -1 0.25" --mirror "x" --contact-camera "0.3 -0.6 1" --field stress_zz
render bolt_pretension --size "$small" --camera "-1 -1.2 0.6" --scale 20 --no-contact
render stress_wave --size "$small" --no-contact --field stress_xx --camera "1 -1 0.4"
render benchmarks/hertz_rings --size "$small" --camera "-1 -0.6 0.35" --focus "0.1 0.1 -0.02" --width 0.5 \
  --contact-camera "-0.4 -0.8 1.6" --contact-width 0.45 --no-outline
render bolted_joint --camera "-0.7 -1 0.7" --contact-camera "0.2 -1 1.6"
render self_contact --size "$small" --camera "0.2 -1 0.2" --mirror "x" --no-contact
render_test cone_obstacle --size "$small" --camera "1 -1.4 0.9" --width 4 --focus "0.7 0.7 -0.5" --contact-camera "0.3 -0.6 1.4" --contact-width 3
render_test torus_obstacle --size "$small" --camera "1 -1.4 0.9" --contact-camera "0.3 -0.6 1.4"
render_test node_sets --size "$small" --camera "0.5 -1.4 0.5" --scale 30 --no-contact
render_test checks/explicit_ball --size "300 360" --time "0.0001 0.0002 0.0003 0.0005" --mirror "x" --camera "0.15 -1 0.12" \
  --range "0 6" --no-contact
render_test pressed_sphere --size "$small" --camera "1 -1.4 0.9" --contact-camera "0.3 -0.6 1.4"
render_test turning_roller --size "$small" --camera "0.5 -1.4 0.5" --contact traction_x --contact-camera "0.3 -0.6 1.4"
render_test springs_and_moments --size "$small" --camera "0.5 -1.4 0.5" --no-contact
render benchmarks/ironing --size "760 400" --camera "0 -1 0" --no-contact
render benchmarks/sliding_block --size "$small" --camera "1 -1.4 0.7" --contact traction_x \
  --contact-camera "0.6 -1 -1.2"
render benchmarks/sliding_block_force --size "$small" --camera "1 -1.4 0.7" --contact traction_x \
  --contact-camera "0.6 -1 -1.2"
render benchmarks/taylor_bar --size "$small" --field equivalent_plastic_strain --unit "" --no-contact \
  --camera "1 -1 0.25" --mirror "x"
render benchmarks/crushed_tube --size "260 400" --field equivalent_plastic_strain --unit "" --no-contact --mirror "x y" \
  --camera "1 -1.6 0.5" --focus "0 0 30" --width 64 --time "0.0004 0.0008 0.0012 0.0016 0.002" --range "0 1"
render benchmarks/twist --camera "1 -1.2 0.6" --contact-camera "0.3 -0.5 -1" --contact-up "0 1 0"

if wants hertz_sphere; then
# Hertz' pressure at the force that was computed: four times that of the quarter.
awk '/"force":/ { gsub(/[^-+0-9.eE,]/, ""); split($0, f, ","); if (!n++) print 4 * (f[3] < 0 ? -f[3] : f[3]) }' \
  "$runs/hertz_sphere/summary.json" >"$runs/hertz_force.txt"
gnuplot <<END
P = real(system("cat $runs/hertz_force.txt"))
E = 210000 / (2 * (1 - 0.3**2)); R = 10
a = (3 * P * R / (4 * E))**(1. / 3); p0 = 3 * P / (2 * pi * a**2)
set terminal pngcairo size 800,480 font "DejaVu Sans,12"
set output "$pictures/hertz_profile.png"
set title sprintf("Hertz contact, ball on block: P = %.1f N, a = %.4f mm, p_0 = %.0f MPa", P, a, p0)
set xlabel "distance from the axis r, mm"
set ylabel "contact pressure, MPa"
set xrange [0:0.26]; set yrange [0:1600]; set key top right; set grid; set samples 2000
plot (x < a ? p0 * sqrt(1 - (x / a)**2) : 0) title "Hertz, p_0 (1 - r^2/a^2)^{1/2}" lw 2 lc rgb "#b03030", \\
  "$runs/hertz_sphere.txt" using (sqrt(\$1**2 + \$2**2)):(\$4) title "slave nodes" pt 7 ps 0.8 lc rgb "#2040a0"
END
fi

# Shallow ironing: forces per mm of depth, ten times those of the slice. Published: smallest and
# largest of Fischer and Wriggers 2006, Hartmann et al. 2009, Yastrebov 2011, Poulios and Renard
# 2015 and Code_Aster, as digitised in the solids4foam tutorial shallowIroning, at the end of the
# press and in the middle of the draw.
if wants ironing_forces; then
run benchmarks/ironing
gnuplot <<END
set terminal pngcairo size 800,480 font "DejaVu Sans,12"
set output "$pictures/ironing_forces.png"
set title "Shallow ironing, force on the block per mm of depth"
set xlabel "time: pressed by 1 mm from 0 to 1, drawn by 10 mm from 1 to 2"
set ylabel "force, N"
set xrange [0:2]; set yrange [0:480]; set key top left; set grid
scaled(t) = t > 1 ? 1 + (t - 1) / 50 : t
plot "$runs/benchmarks/ironing/statistics" using (scaled(\$2)):(10 * \$9) with lines lw 2 lc rgb "#2040a0" title "vertical", \\
  "" using (scaled(\$2)):(-10 * \$7) with lines lw 2 lc rgb "#b03030" title "horizontal", \\
  "-" with yerrorbars lw 2 lc rgb "#606060" title "published, from smallest to largest"
1.0 300 267.9 332
1.5 379 337.4 421
1.0 63 55.3 71
1.5 145 102.1 188.8
e
END
fi

# Partial slip: tractions at the nodes against Cattaneo and Mindlin.
if wants partial_slip; then
run benchmarks/cattaneo_mindlin
contrib/contact_points "$runs"/benchmarks/cattaneo_mindlin/contact_0008.vtu >"$runs/slip.txt"
awk '/"force":/ { sub(/.*force/, ""); gsub(/[^-+0-9.eE,]/, ""); split($0, f, ","); if (!n++) print f[3] / 0.25, -f[1] / 0.25 }' \
  "$runs/benchmarks/cattaneo_mindlin/summary.json" >"$runs/slip_forces.txt"
gnuplot <<END
P = real(system("cut -d' ' -f1 $runs/slip_forces.txt")); Q = real(system("cut -d' ' -f2 $runs/slip_forces.txt"))
mu = 0.3; R = 50; E = 210000 / (2 * (1 - 0.3**2))
a = sqrt(4 * P * R / (pi * E)); p0 = 2 * P / (pi * a); c = a * sqrt(1 - Q / (mu * P))
root(x, b) = abs(x) < b ? sqrt(1 - (x / b)**2) : 0
set terminal pngcairo size 800,480 font "DejaVu Sans,12"
set output "$pictures/partial_slip.png"
set title sprintf("Cattaneo and Mindlin: Q = %.3f {/Symbol m}P, a = %.3f mm, c = %.3f mm", Q / (mu * P), a, c)
set xlabel "x, mm"; set ylabel "traction, MPa"
set xrange [-1.1:1.1]; set yrange [0:470]; set key top center; set grid; set samples 4000
plot mu * p0 * root(x, a) title "limit {/Symbol m}p" lw 1 dt 2 lc rgb "#606060", \\
  mu * p0 * (root(x, a) - c / a * root(x, c)) title "shear traction, exact" lw 2 lc rgb "#b03030", \\
  "$runs/slip.txt" using 1:(0.3 * \$7) title "nodes, {/Symbol m}p" pt 6 ps 0.7 lc rgb "#606060", \\
  "" using 1:(-\$11) title "nodes, shear traction" pt 7 ps 0.7 lc rgb "#2040a0"
END
fi

# Impact of two bars: the contact stress over time with three schemes, a wave passes one cell per step.
if wants bar_impact; then
for scheme in newmark contact_stabilized generalized_alpha; do
  mass=lumped
  [ "$scheme" != generalized_alpha ] || mass="dispersion corrected"
  [ -f "$runs/bars_$scheme/statistics" ] || "$program" --output "$runs/bars_$scheme" \
    --set "Time integration/Scheme=$scheme" --set "Time integration/Mass=$mass" \
    --set "Load stepping/Steps=250" \
    --set "Body left/Geometry/Cells=100,1,1" --set "Body right/Geometry/Cells=100,1,1" \
    --set "Output/VTU interval=0" prm/benchmarks/two_bars.prm >"$runs/bars_$scheme.log"
done
gnuplot <<END
set terminal pngcairo size 800,480 font "DejaVu Sans,12"
set output "$pictures/bar_impact.png"
set title "Impact of two bars of 100 cells, a wave passes one cell per step"
set xlabel "time, microseconds"; set ylabel "contact stress, MPa"
set xrange [0:45]; set yrange [0:450]; set key top right; set grid
plot "$runs/bars_newmark/statistics" using (1e6 * \$2):(abs(\$7) / 100) with lines lw 1 lc rgb "#b0b0b0" title "newmark, lumped", \\
  "$runs/bars_contact_stabilized/statistics" using (1e6 * \$2):(abs(\$7) / 100) with lines lw 2 lc rgb "#2040a0" title "contact-stabilized, lumped", \\
  "$runs/bars_generalized_alpha/statistics" using (1e6 * \$2):(abs(\$7) / 100) with lines lw 2 lc rgb "#b03030" title "generalized alpha, dispersion corrected"
END
fi

# The plate: energies and contact force, with the impacts of the published case as well.
if wants plate_drop_energies; then
run plate_drop
[ -f "$runs/plate_elastic/summary.json" ] || "$program" --output "$runs/plate_elastic" \
  --set "Time integration/Impact=elastic" --set "Linear solver/Type=Belos CG" \
  --set "Output/VTU interval=0" prm/plate_drop.prm >"$runs/plate_elastic.log"
gnuplot <<END
set terminal pngcairo size 900,420 font "DejaVu Sans,11"
set output "$pictures/plate_drop_energies.png"
set multiplot layout 1,2
set xlabel "time, microseconds"; set ylabel "energy, 1e-3 N mm"; set grid; set key center right
set title "Plate drop: where the energy is"
plot "$runs/plate_drop/statistics" using (1e6*\$2):(1e3*\$27) with lines lw 2 lc rgb "#2040a0" title "kinetic", \\
  "" using (1e6*\$2):(1e3*\$28) with lines lw 2 lc rgb "#b03030" title "plastic", \\
  "" using (1e6*\$2):(1e3*\$29) with lines lw 2 lc rgb "#208040" title "strain", \\
  "" using (1e6*\$2):(1e3*(\$27+\$28+\$29+\$23)) with lines lw 1 dt 2 lc rgb "#606060" title "sum, with contact"
set title "Contact force"; set ylabel "N"; set key bottom right
plot "$runs/plate_elastic/statistics" using (1e6*\$2):9 with lines lw 1 lc rgb "#b0b0b0" title "elastic impacts", \\
  "$runs/plate_drop/statistics" using (1e6*\$2):9 with lines lw 2 lc rgb "#2040a0" title "no rebound"
END
fi
ls -l "$pictures"
