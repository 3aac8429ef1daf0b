#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes the meshes that gmsh makes here (Debian's package gmsh, 4.8): the plate
# in formats 2.2, 4.0 and 4.1 and for Abaqus, and the target. Into this folder,
# or into the one named:
#     meshes/make_gmsh.sh [FOLDER]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here}
make() { gmsh -nt 1 -v 1 "-$1" -format "$2" -o "$out/$4" "$here/$3"; }
make 2 msh22 plate.geo plate-22.msh
make 2 msh40 plate.geo plate-40.msh
make 2 msh41 plate.geo plate-41.msh
make 2 inp plate.geo plate.inp
make 3 msh41 target.geo target.msh
# gmsh dates nothing but this: the first lines of an .inp
sed -i '2s/.*/plate, by gmsh/' "$out/plate.inp"
