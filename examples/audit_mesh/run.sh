#!/bin/sh
# run.sh [PLUMB]: audits a mesh, then shows what a wrong place looks like. Writes into the folder where it is run.
set -eu
plumb=${1:-plumb}
terrain='generate:alpine?size=257&seed=7'

# In place of your renderer: the mesh that it draws at two pixels.
"$plumb" render "$terrain" --tolerance 2px --camera oblique --size 320x180 -o picture.png --mesh drawn.ply

# Does it keep to them? All that a picture has, and what only a mesh has: samples, edges, normals. Exit status 0: yes, 1: no.
"$plumb" audit "$terrain" --mesh drawn.ply --camera oblique --size 320x180 --tolerance 2px -o report

# As much in metres, which needs no camera to mean something: here it does not, exit status 1.
status=0
"$plumb" audit "$terrain" --mesh drawn.ply --camera oblique --size 320x180 --tolerance 2m || status=$?
test "$status" -eq 1

# The same mesh placed wrongly: named in one line, and no error is quoted. Exit status 2.
for wrong in '--up y' '--scale 0.3048' '--offset 100000,0,0'; do
  status=0
  # shellcheck disable=SC2086
  "$plumb" audit "$terrain" --mesh drawn.ply --camera oblique --size 320x180 --tolerance 2px $wrong || status=$?
  test "$status" -eq 2
done
