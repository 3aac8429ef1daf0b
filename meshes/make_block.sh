#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# Writes block.msh (gmsh 2.2): n x n x n hexahedra of a cube of edge 10 mm, the
# face z = 0 as physical surface 1, the rest of the boundary 2, the volume 3.
#     meshes/make_block.sh 4 > meshes/block.msh
# With a second number one element near the middle is a sliver of that thickness,
# in edges of the others:
#     meshes/make_block.sh 8 .1 > meshes/sliver.msh
set -euo pipefail
awk -v n="${1:-4}" -v thin="${2:-1}" '
# Four nodes, those of one side of the sliver, come close to the other side.
function along(i, j, k) {
  m = int(n / 2)
  return thin < 1 && i == m + 1 && (j == m || j == m + 1) && (k == m || k == m + 1) ? m + thin : i
}
function node(i, j, k) { return 1 + i + (n + 1) * (j + (n + 1) * k) }
BEGIN {
  printf "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n", (n + 1) ^ 3
  for (k = 0; k <= n; ++k) for (j = 0; j <= n; ++j) for (i = 0; i <= n; ++i)
    printf "%d %.12g %.12g %.12g\n", node(i, j, k), .01 * along(i, j, k) / n, .01 * j / n, .01 * k / n
  printf "$EndNodes\n$Elements\n%d\n", n ^ 3 + 6 * n ^ 2
  for (b = 0; b < n; ++b) for (a = 0; a < n; ++a) {
    quad(1, node(a, b, 0), node(a + 1, b, 0), node(a + 1, b + 1, 0), node(a, b + 1, 0))
    quad(2, node(a, b, n), node(a + 1, b, n), node(a + 1, b + 1, n), node(a, b + 1, n))
    quad(2, node(a, 0, b), node(a + 1, 0, b), node(a + 1, 0, b + 1), node(a, 0, b + 1))
    quad(2, node(a, n, b), node(a + 1, n, b), node(a + 1, n, b + 1), node(a, n, b + 1))
    quad(2, node(0, a, b), node(0, a + 1, b), node(0, a + 1, b + 1), node(0, a, b + 1))
    quad(2, node(n, a, b), node(n, a + 1, b), node(n, a + 1, b + 1), node(n, a, b + 1))
  }
  for (k = 0; k < n; ++k) for (j = 0; j < n; ++j) for (i = 0; i < n; ++i)
    printf "%d 5 2 3 3 %d %d %d %d %d %d %d %d\n", ++e, node(i, j, k), node(i + 1, j, k),
           node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
           node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1)
  print "$EndElements"
}
function quad(id, p, q, r, s) { printf "%d 3 2 %d %d %d %d %d %d\n", ++e, id, id, p, q, r, s }'
