#!/bin/sh
# Draws the pictures of images/ anew, each by the script that it is of, at that script's own size.
#
#   tests/figure/draw_images.sh DOTYK [quick|rounding|long|timed|SCRIPT]…        puts them into images/; without names all but timed
#   tests/figure/draw_images.sh --compare SAME_PICTURE DOTYK [quick|rounding|long|SCRIPT]…  changes nothing, and fails where one differs
#
# SCRIPT is a file of scripts/ without .lua, as studies/stability/rho. A picture whose script fails stays as it is.
# Pictures that show seconds or memory are timed: to be drawn on a machine that does nothing else, never compared. Of the others those
# are quick whose scripts take up to six seconds of a processor; the test figure/images compares them, but for those of
# rounding: they show residuals of 1e-16, or labels of axes that start at errors of 1e-9, which differ from processor to processor.
# long: up to some minutes; to be compared by hand after changes of solvers or figures, or once a week.
quick="first examples/friction examples/asperities examples/two_blocks examples/tower examples/corner examples/stack examples/several_solutions
  examples/ladder examples/socket examples/gear_pair examples/flange papers/tr965/screws examples/breaking examples/beam examples/foundation
  examples/supports studies/accuracy/hertz examples/ball examples/gears examples/lug examples/load_cone
  papers/horak_fibinger/plate_cases examples/plate_corners examples/plate_obstacle papers/hlavacova/channel
  papers/alesawi/augmented_lagrangian studies/methods/coulomb_loop studies/stability/uzawa studies/stability/locking
  studies/stability/load_limit studies/stability/stretched papers/horak/beam_foundations papers/horak/beam_breaking"
rounding="studies/methods/penalty studies/stability/degenerate studies/stability/rho studies/stability/contrast studies/stability/multigrid
  studies/stability/weak_springs studies/stability/screws studies/stability/overconstrained studies/stability/penalty papers/horak/beam_examples studies/accuracy/beam_laws"
long="examples/punch studies/accuracy/cattaneo_mindlin studies/accuracy/mortar papers/vondrak/cont examples/roller examples/wall
  papers/dostal/three_blocks examples/plate examples/plate_friction examples/thermoelastic papers/netuka/semicoercive
  papers/tr965/inf_sup papers/tr965/open_question studies/matrices/cycles papers/tr965/alternating studies/accuracy/shape_derivatives
  papers/vondrak/iter studies/stability/coulomb studies/stability/cycling studies/stability/inf_sup
  papers/tr965/cube_with_friction papers/alesawi/augmented_estimates papers/alesawi/raised_penalties papers/tr965/friction_cells
  papers/netuka/semicoercive_theorems papers/netuka/semicoercive_working_sets papers/horak_fibinger/plate_edges
  papers/tr965/screws_with_friction papers/tr965/normalisation papers/tr965/report_scaling papers/tr965/rates
  papers/tr965/newton_remainder papers/tr965/m_matrix papers/hlavacova/channel_fields papers/dostal/penalised_spectra
  papers/vondrak/cont_figures papers/vondrak/cont_table papers/netuka/modified_cholesky"
timed="studies/accuracy/adaptivity studies/matrices/fclib studies/methods/feti_scaling studies/accuracy/second_order
  studies/stability/interrupted studies/work_precision/ball studies/work_precision/beam studies/work_precision/friction
  studies/work_precision/hertz studies/work_precision/plate studies/work_precision/semicoercive studies/work_precision/three_blocks
  studies/work_precision/tolerances studies/scale"

usage() { sed -n '2,10s/^# \{0,1\}//p' "$0"; exit 2; }
same=
if [ "$1" = --compare ]; then same=$(realpath "$2"); shift 2; fi
[ -x "$1" ] || usage
dotyk=$(realpath "$1"); shift
root=$(realpath "$(dirname "$0")/../..")
[ $# -gt 0 ] || set -- quick rounding long
scripts=
for name; do
  case $name in
    quick) scripts="$scripts $quick" ;;
    rounding) scripts="$scripts $rounding" ;;
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
