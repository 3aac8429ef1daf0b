#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-2.1-or-later
# readme_commands.sh SOURCE OGIVE: runs each "build/release/ogive ..." line of
# the README's sh blocks, in their order, in an empty folder that sees the scenes.
set -euo pipefail
source_dir=$1
ogive=$2

here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
mkdir -p "$here/build/release"
ln -s "$ogive" "$here/build/release/ogive"
ln -s "$source_dir/apps" "$here/apps"
cd "$here"

commands=$(awk '/^```/ { block = ($0 == "```sh" && !block); next }
                block && /^build\/release\/ogive / { sub(/  #.*/, ""); print }' "$source_dir/README.md")
[[ -n "$commands" ]] || { echo "README.md shows no command of the program" >&2; exit 1; }

while IFS= read -r command; do
  echo "+ $command"
  bash -c "$command" </dev/null
done <<<"$commands"
