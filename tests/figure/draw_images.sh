#!/bin/sh
# Draws the pictures of images/ anew, each by the script that it is of, at that script's own size.
#
#   tests/figure/draw_images.sh DOTYK [quick|long|timed|SCRIPT]…                 puts them into images/; without names quick and long
#   tests/figure/draw_images.sh --compare SAME_PICTURE DOTYK [quick|long|SCRIPT]…  changes nothing, and fails where one differs
#
# SCRIPT is a file of scripts/ without .lua, as stability/rho. A picture whose script fails stays as it is.
# Pictures that show seconds or memory are timed: to be drawn on a machine that does nothing else, never compared. Of the others those
# are quick whose scripts take up to six seconds of a processor; the test figure/images compares them.
# long: up to some minutes; to be compared by hand after changes of solvers or figures, or once a week.
quick="first friction two_blocks tower corner stack several_solutions ladder screws breaking beam beam_laws foundation supports hertz ball
  gears lug load_cone plate_cases plate_corners plate_obstacle channel penalty augmented_lagrangian coulomb_loop stability/degenerate stability/uzawa
  stability/rho stability/locking stability/contrast stability/weak_springs stability/load_limit stability/overconstrained
  stability/penalty stability/stretched papers/beam_examples papers/beam_foundations papers/beam_breaking"
long="punch cattaneo_mindlin mortar cont roller wall three_blocks plate plate_friction thermoelastic semicoercive inf_sup
  open_question cycles alternating shape_derivatives iter stability/coulomb stability/cycling stability/inf_sup stability/screws
  papers/cube_with_friction papers/augmented_estimates papers/raised_penalties papers/friction_cells
  papers/semicoercive_theorems papers/semicoercive_working_sets
  papers/plate_edges papers/screws_with_friction papers/normalisation papers/report_scaling
  papers/rates papers/newton_remainder papers/m_matrix
  papers/channel_fields
  papers/penalised_spectra
  papers/cont_figures papers/cont_table
  papers/modified_cholesky"
timed="adaptivity fclib feti_scaling second_order stability/interrupted work_precision/ball work_precision/beam
  work_precision/friction work_precision/hertz work_precision/plate work_precision/semicoercive work_precision/three_blocks
  work_precision/tolerances"

usage() { sed -n '2,9s/^# \{0,1\}//p' "$0"; exit 2; }
same=
if [ "$1" = --compare ]; then same=$(realpath "$2"); shift 2; fi
[ -x "$1" ] || usage
dotyk=$(realpath "$1"); shift
root=$(realpath "$(dirname "$0")/../..")
[ $# -gt 0 ] || set -- quick long
scripts=
for name; do
  case $name in
    quick) scripts="$scripts $quick" ;;
    long) scripts="$scripts $long" ;;
    timed) scripts="$scripts $timed" ;;
    *) [ -f "$root/scripts/$name.lua" ] || { echo "draw_images.sh: no script scripts/$name.lua" >&2; exit 2; }
       scripts="$scripts $name" ;;
  esac
done

scratch=$(mktemp -d) || exit 2
trap 'rm -rf "$scratch"' EXIT
trap 'exit 130' INT TERM
failed=0
for script in $scripts; do
  rm -rf "$scratch/images" && mkdir "$scratch/images" && cd "$scratch" || exit 2
  if ! "$dotyk" "$root/scripts/$script.lua" > log 2>&1; then
    echo "scripts/$script.lua failed: $(tail -n 1 log)"; failed=1
    continue
  fi
  for picture in images/*; do
    if [ -z "$same" ]; then cp "$picture" "$root/$picture"
    elif [ "${picture%.png}" != "$picture" ]; then
      [ -f "$root/$picture" ] && "$same" "$root/$picture" "$picture" || { echo "scripts/$script.lua: $picture is not the one in $root"; failed=1; }
    fi
  done
  [ -n "$same" ] || echo "$script: $(ls images | tr '\n' ' ')"
done
exit $failed
