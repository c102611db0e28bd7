# Begins the tests beside it: the program, an empty folder to work in, which goes at the end, and what has failed.
set -u
dotyk=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0
fail() {
  printf 'FAILED: %s\n' "$1"
  failures=$((failures + 1))
}

# Are there terminals for $typist? A bare chroot has no /dev/pts.
terminals() {
  "$typist" true >/dev/null 2>&1
  [[ $? != 77 ]] && return
  echo "no pseudo-terminals (/dev/pts): the prompt is left out"
  return 1
}

# Waits until process $1 is dotyk and catches Ctrl-C, and then a little, so that it is at work.
await_handler() {
  local caught
  for _ in {1..600}; do
    caught=$(sed -n 's/^SigCgt:\t*//p' "/proc/$1/status" 2>/dev/null)
    [[ $caught && $(<"/proc/$1/comm") == dotyk ]] && ((0x$caught & 2)) && sleep 0.3 && return
    sleep 0.1
  done
  fail "process $1 does not catch Ctrl-C"
}
