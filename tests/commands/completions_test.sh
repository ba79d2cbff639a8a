#!/usr/bin/env bash
# Completions of the shells that are installed offer the options of the command. Usage: completions_test.sh SOURCE BIN
set -euo pipefail
source=$1 bin=$2
export PATH=$bin:$PATH

# What bash offers after `pcd_bv $1`.
offered_by_bash() {
  bash --norc -c '. "$0"; COMP_WORDS=(pcd_bv "$1"); COMP_CWORD=1; _pcl_bv pcd_bv; printf "%s\n" "${COMPREPLY[@]}"' \
    "$source/nodes/commands/completions/pcl_bv.bash" "$1"
}

expect() { # WHAT GIVEN: fails unless a line of GIVEN is WHAT
  grep -qxe "$1" <<<"$2" || { echo "completion: '$1' is not offered, but: $2" >&2; exit 1; }
}

expect --volume "$(offered_by_bash --vol)"
expect --cluster "$(offered_by_bash --)"
[ -z "$(offered_by_bash sca)" ] || { echo "completion: a file name is completed by options" >&2; exit 1; }
[ -z "$(offered_by_bash --no-such)" ] || { echo "completion: an unknown option is completed" >&2; exit 1; }
if command -v fish >/dev/null; then
  expect --volume "$(fish -N -c "source '$source/nodes/commands/completions/pcl_bv.fish'; complete -C 'pcd_bv --vol'")"
fi
if command -v zsh >/dev/null; then zsh -fn "$source/nodes/commands/completions/_pcl_bv"; fi
