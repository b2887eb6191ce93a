#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# [BIN=build/release/bin] [WORK=build/experiments] [OUT=docs/experiments] [NOTE="..."] [ROWS="..."]
#   experiments.sh [--quick] [EXPERIMENT...]
# The paper's experiments: measures what is not yet in WORK and writes the page OUT/README.md with
# tables, charts and the reel. Can be stopped and started again at any time: what is done is not done
# again. Delete a folder of WORK to have that part anew, or all of WORK after a change of the program.
# Reports of searches that take hours are kept in OUT/reports as well, and taken from there: delete
# them there, too.
# EXPERIMENT: table1 graph planners table2 orientations database_size reel, all of them without; or
# exact, printed, paper_cut or paper, other readings of planner "graph"; or page, which only writes
# the page again. NOTE stands at the top of the page: what else the machine did, for example. ROWS
# are the objects and surfaces to measure, "d6@desk Nut@desk", without it all of them. Needs python3
# and, for the reel, ffmpeg (scripts/install_packages.sh foreign).
# --quick: a few small searches of each kind, into WORK/quick, and a look at what was written: shows
# that all of it works.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$(realpath "${BIN:-build/release/bin}")
ifa=$bin/ifa
work=${WORK:-build/experiments}
out=${OUT:-docs/experiments}
quick=
if [ "${1:-}" = --quick ]; then
  quick=yes
  shift
fi
chosen=("$@")

mapfile -t rows < <("$bin/make_evaluation" --rows)
[ -z "${ROWS:-}" ] || read -ra rows <<<"$ROWS"
drops=1500 limit=10 graph_limit=5 paper_limit=3 simulations=400000 seconds=60
places="Lego2x4@desk:3:0.2 Garlic@wood:2:0.3 TapeDispenser@wood:3:0.35"
wishes="d6@desk:5:1=up,2=up,3=up,4=up,5=up,6=up Lego2x2@desk:10:studs=up,studs=down"
wishes+=" Lego2x4@desk:10:studs=up,studs=down Keyboard@carpet:10:keys=up"
sizes="6250 12500 25000 50000 100000 200000 400000"
size_rows="CoatHanger@desk d6@desk Eraser@desk Lego2x2@desk"
film="--size 640x360"
if [ -n "$quick" ]; then
  rows=(Eraser@desk Garlic@wood)
  drops=40 limit=1 graph_limit=1 paper_limit=1 simulations=500 seconds=2
  places="Garlic@wood:1:0"
  wishes="Eraser@desk:1:0,0,1=up"
  sizes="250 500" size_rows="Eraser@desk"
  film="--size 160x90 --fps 10"
  work=$work/quick out=$work/page
  rm -rf "$work"
fi
mkdir -p "$work" "$out"
work=$(realpath "$work")
export XDG_CACHE_HOME=$work/cache
large_cache=$work/large_cache  # databases that are deleted after use

say() { echo "$*" >&2; }

# set_of ROW [KIND [OPTION...]]: names the folder with the evaluation set of one row, which is made
# where it is missing. The ten objects of tests/evaluation have theirs there.
set_of() {
  local row=$1 kind=${2:-sets} name=${1%@*}
  local folder=$work/$kind/$row
  if [ ! -e "$folder/README.md" ]; then
    say "making $folder"
    rm -rf "$folder"
    mkdir -p "$folder"
    if [ "$kind" = sets ] && [ -d "tests/evaluation/$name" ]; then
      cp -r "tests/evaluation/$name" "$folder/$row"
      cp tests/evaluation/README.md "$folder/README.md"
    else
      "$bin/make_evaluation" "$row" -n "$drops" -o "$folder" "${@:3}" >/dev/null
    fi
  fi
  echo "$folder"
}

# evaluate NAME SET [OPTION...]: WORK/NAME.json, if it is not there yet.
evaluate() {
  local name=$1 set=$2
  shift 2
  [ ! -e "$work/$name.json" ] || return 0
  say "$name"
  mkdir -p "$work/$name.part"
  local part=$work/$name.part
  "$ifa" evaluate "$set" --parity odd -o "$part/report" "$@" >/dev/null 2>>"$work/log"
  mv "$part/report.json" "$work/$name.json"
  rm -r "$part"
}

# report NAME [OPTION...] -- JSON...: the page's tables and charts of what there is of some reports.
report() {
  local name=$1 options=()
  shift
  while [ "$1" != -- ]; do
    options+=("$1")
    shift
  done
  shift
  [ -e "${1:-}" ] || return 0
  "$ifa" evaluate "$@" "${options[@]}" -o "$out/$name" >/dev/null
  mv "$out/$name.json" "$work/$name.json"
}

# fetch NAME: WORK/NAME.json of OUT/reports, if it is not there yet; false where neither has it.
fetch() {
  [ ! -e "$work/$1.json" ] || return 0
  [ -e "$out/reports/$1.json" ] || return 1
  mkdir -p "$work/${1%/*}"
  cp "$out/reports/$1.json" "$work/$1.json"
}

# keep NAME: WORK/NAME.json to OUT/reports.
keep() {
  mkdir -p "$out/reports/${1%/*}"
  cp "$work/$1.json" "$out/reports/$1.json"
}

# search READING ROW: planner "graph" by one way of reading the paper (docs/branch-and-bound.md):
# graph, our own; exact, without images; printed; paper_cut, the first with the paper's cut of
# events; paper, printed with that cut.
search() {
  local reading=$1 row=$2 name=${2%@*} kind=sets cut=audible count=$graph_limit options=() set
  ! fetch "$reading/$row" || return 0
  case $reading in
    paper_cut | paper) kind=paper_sets cut=paper count=$paper_limit ;;
  esac
  case $reading in
    exact) options=(--no-symmetry) ;;
    printed | paper) options=(--no-symmetry --printed-velocity --connection blend) ;;
  esac
  set=$(set_of "$row" $kind --cut $cut)
  # The readings of one row share its database, no two rows are on the disk at a time.
  [ -e "$large_cache/$row-$cut" ] || rm -rf "$large_cache"
  XDG_CACHE_HOME=$large_cache "$ifa" database build "$name" --surface "${row#*@}" \
    -n "$simulations" --cut $cut >/dev/null 2>>"$work/log"
  touch "$large_cache/$row-$cut"
  XDG_CACHE_HOME=$large_cache evaluate "$reading/$row" "$set" --limit "$count" --jobs 2 \
    --planner graph --early-exit 1 --simulations "$simulations" --processor-time \
    --time-limit "$seconds" --cut $cut "${options[@]}"
  keep "$reading/$row"
}

# searches READING...
searches() {
  for row in "${rows[@]}"; do
    for reading in "$@"; do search "$reading" "$row"; done
  done
  rm -rf "$large_cache"
}

table1() {
  for row in "${rows[@]}"; do evaluate "hybrid/$row" "$(set_of "$row")" --limit $limit; done
}

planners() {
  for row in "${rows[@]}"; do
    evaluate "shoot/$row" "$(set_of "$row")" --limit $graph_limit --planner shoot
  done
}

# Three, two and three motions, as the paper's, whose paths are as long where drops go so far.
table2() {
  local row count side
  for place in $places; do
    IFS=: read -r row count side <<<"$place"
    evaluate "table2/$row" "$(set_of "$row" place_sets --positions --least-side "$side")" \
      --limit "$count"
  done
}

orientations() {
  local row count list
  for wish in $wishes; do
    IFS=: read -r row count list <<<"$wish"
    evaluate "unoriented/$row" "$(set_of "$row")" --limit "$count"
    for face in ${list//=up,/=up }; do
      evaluate "orientations/$row-$face" "$(set_of "$row")" --limit "$count" --orient "last:$face"
    done
  done
}

# As Figure 16: the same sound, databases of several sizes, no early exit. Two at a time.
database_size() {
  for row in $size_rows; do set_of "$row" >/dev/null; done
  for size in $sizes; do
    for row in $size_rows; do
      ! fetch "database_size/$size-$row" || continue
      while [ "$(jobs -rp | wc -l)" -ge 2 ]; do wait -n; done
      XDG_CACHE_HOME=$large_cache evaluate "database_size/$size-$row" "$work/sets/$row" --limit 1 --planner graph \
        --simulations "$size" --early-exit 1 --processor-time --time-limit $seconds &
    done
    wait
    rm -rf "$large_cache"
    for row in $size_rows; do
      [ -e "$work/database_size/$size-$row.json" ] || return 1
      keep "database_size/$size-$row"
    done
  done
}

# clip ROW CASE: WORK/reel/ROW.mp4, with the row's name and a sound of its own.
clip() {
  local row=$1 case=$2 clip=$work/reel/$1
  say "reel, $row"
  rm -rf "$clip"
  {
    "$ifa" sync "$work/sets/$row/$row/$case.signature.json" --object "${row%@*}" \
      --surface "${row#*@}" --formats json -o "$clip"
    "$ifa" sonify "$clip" --reverb 0.3 -o "$clip.wav"
    # shellcheck disable=SC2086
    "$ifa" render "$clip" -o "$clip.film.mp4" $film --camera close-up --mute
  } >/dev/null 2>>"$work/log"
  ffmpeg -v error -y -i "$clip.film.mp4" -i "$clip.wav" -map 0:v -map 1:a -af apad -shortest \
    -vf "tpad=stop_mode=clone:stop_duration=0.5,drawtext=text='${row%@*}, ${row#*@}':x=h/24:y=h/24:\
fontsize=h/18:fontcolor=white:box=1:boxcolor=black@0.5:boxborderw=6" \
    -c:v libx264 -crf 18 -pix_fmt yuv420p -c:a aac -bitexact "$clip.part.mp4"
  mv "$clip.part.mp4" "$clip.mp4"
  rm -r "$clip.film.mp4" "$clip.wav" "$clip"
}

# A solved case of each row, one after the other.
reel() {
  command -v ffmpeg >/dev/null || { say 'no ffmpeg: no reel'; return 0; }
  local row case
  mkdir -p "$work/reel"
  : >"$work/reel/list"
  for row in "${rows[@]}"; do
    [ -e "$work/hybrid/$row.json" ] || continue
    if [ ! -e "$work/reel/$row.mp4" ]; then
      case=$(python3 scripts/experiments_page.py best "$work/hybrid/$row.json")
      [ -n "$case" ] || continue
      clip "$row" "$case"
    fi
    echo "file '$row.mp4'" >>"$work/reel/list"
  done
  [ -s "$work/reel/list" ] || return 0
  ffmpeg -v error -y -f concat -safe 0 -i "$work/reel/list" -c:v libx264 -crf 29 -preset slow \
    -c:a copy -bitexact -movflags +faststart "$out/reel.mp4"
}

page() {
  shopt -s nullglob
  report hybrid -- "$work"/hybrid/*.json
  local others=("$work"/{shoot,graph}/*.json)
  [ ${#others[@]} -eq 0 ] ||
    report planners --limit $graph_limit -- "$work"/hybrid/*.json "${others[@]}"
  report paper_cut -- "$work"/paper_cut/*.json
  report readings -- "$work"/{exact,printed,paper}/*.json
  report table2 -- "$work"/table2/*.json
  report orientations -- "$work"/unoriented/*.json "$work"/orientations/*.json
  local size by_size=()
  for size in $sizes; do by_size+=("$work/database_size/$size-"*.json); done
  report database_size -- "${by_size[@]}"
  python3 scripts/experiments_page.py page "$work" "$out"
  say "the page is $out/README.md"
}

all=(table1 graph planners table2 orientations database_size reel)
readings=(graph exact printed paper_cut paper)
experiments() {
  local experiment chosen_readings=()
  for experiment in "${chosen[@]:-${all[@]}}"; do
    case " ${all[*]} ${readings[*]} page " in
      *" $experiment "*) ;;
      *)
        say "no experiment $experiment: ${all[*]} ${readings[*]} page"
        exit 2
        ;;
    esac
  done
  for experiment in "${readings[@]}"; do
    [[ " ${chosen[*]:-${all[*]}} " != *" $experiment "* ]] || chosen_readings+=("$experiment")
  done
  for experiment in "${chosen[@]:-${all[@]}}"; do
    case " ${readings[*]} page " in
      *" $experiment "*) ;;
      *) "$experiment" ;;
    esac
  done
  [ ${#chosen_readings[@]} -eq 0 ] || searches "${chosen_readings[@]}"
}

[ -z "${NOTE:-}" ] || echo "$NOTE" >"$work/note"
experiments
page
if [ -n "$quick" ]; then
  ifa=false experiments # what is done is not done again
  [ ${#chosen[@]} -gt 0 ] || python3 scripts/experiments_page.py check "$out"
fi
