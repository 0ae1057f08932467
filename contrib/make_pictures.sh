#!/bin/sh
# Run the scenes of the documentation and make its pictures, doc/pictures/*.png.
# Needs ParaView and gnuplot: apt-get install paraview xvfb xauth gnuplot-nox
#
# Usage: contrib/make_pictures.sh [PROGRAM]      (build/touchstone)
set -eu
# One display for all pictures; its server needs a moment to start.
[ -n "${DISPLAY-}" ] || exec xvfb-run -n $((100 + $$ % 900)) -w 5 sh "$0" "$@"
cd "$(dirname -- "$0")/.."
program=${1:-build/touchstone}
runs=output/pictures
pictures=doc/pictures
mkdir -p "$runs" "$pictures"

run()
{
  [ -f "$runs/$1/solution.pvd" ] || "$program" --output "$runs/$1" "prm/$1.prm" >"$runs/$1.log"
}

# render NAME OPTION...
render()
{
  name=$1
  shift
  pvbatch contrib/render.py "$runs/$name" "$pictures/$name.png" "$@"
}

run press_fit
render press_fit --unit MPa --camera "0.35 -0.6 1" --up "0 1 0" \
  --contact-camera "-1 -1 0.7" --contact-up "0 0 1"

run two_tubes
render two_tubes --unit MPa --camera "0.5 0.75 0.9" --up "0 1 0" --zoom 0.95 \
  --contact-camera "0.5 -0.6 -0.6" --contact-up "0 1 0"

run hertz_sphere
render hertz_sphere --unit MPa --camera "-1 -0.6 0.35" --focus "0.1 0.1 -0.05" --zoom 6 \
  --contact-camera "-0.4 -0.8 1.6" --contact-zoom 9 --points "$runs/hertz_sphere.txt"

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
ls -l "$pictures"
