#!/bin/sh
# run.sh [PLUMB]: audits a depth buffer, then shows what a wrong convention looks like. Writes into the folder where it is run.
set -eu
plumb=${1:-plumb}
terrain='generate:alpine?size=257&seed=7'

# The camera that the frame was drawn with: of yours, these are an engine's two matrices as well (docs/cameras.md).
cat > camera.toml <<'TOML'
eye = [-900, -1100, 3600]
target = [3840, 3840, 900]
fov_y_deg = 50
width = 320
height = 180
near = 1
far = 100000
TOML

# In place of your renderer: a frame that keeps to two pixels. Its channel Z is view depth in metres, +inf is sky.
"$plumb" render "$terrain" --tolerance 2px --camera camera.toml -o depth.exr

# Does it? Every pixel's point, against the terrain. Exit status 0: yes, 1: no.
"$plumb" audit "$terrain" --depth depth.exr --camera camera.toml --tolerance 2px -o report

# The same buffer taken for another: named in one line, and no error is quoted. Exit status 2.
for wrong in '--depth-convention distance' '--depth-convention reverse-z' '--depth-y up'; do
  status=0
  # shellcheck disable=SC2086
  "$plumb" audit "$terrain" --depth depth.exr --camera camera.toml --tolerance 2px $wrong || status=$?
  test "$status" -eq 2
done
