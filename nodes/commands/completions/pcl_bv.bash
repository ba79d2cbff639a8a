# Completes the options of the commands in bash. They come from --help, so they are those of the installed version.
_pcl_bv() {
  local current=${COMP_WORDS[COMP_CWORD]}
  COMPREPLY=()
  if [[ $current != -* ]]; then
    compopt -o default 2>/dev/null # names of files
    return
  fi
  mapfile -t COMPREPLY < <(compgen -W "$("$1" --help 2>/dev/null | grep -oE -- '--[a-z][a-z0-9-]*' | sort -u)" -- "$current")
}
complete -F _pcl_bv pcd_bv pcd_bv_mpi bv_stream synth
