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
