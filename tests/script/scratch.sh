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

# Are there terminals to type at? A bare chroot has no /dev/pts.
terminals() {
  script -qec true /dev/null >/dev/null 2>&1 && return
  echo "no pseudo-terminals (script(1), /dev/pts): the prompt is left out"
  return 1
}
