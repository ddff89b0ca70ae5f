#!/bin/sh
# Counts instructions, misses of caches as large as a Zen 3 core's (32 KB, 512 KB) and mispredicted branches, as callgrind
# sees them, per element inserted, loaded or paired, and per query: BBTT beside Boost's R-tree, boxes in space.
#   bench/spatial_instructions/run.sh build/release/bin/bench_spatial_instructions [uniform [100000]]
set -eu
program=$1
data=${2:-uniform}
count=${3:-100000}
out=$(mktemp)
trap 'rm -f "$out"' EXIT
printf '| operation | container | instructions | beyond 32 KB | beyond 512 KB | mispredicted |\n|---|---|---|---|---|---|\n'
for line in 'insert 0 bbtt' 'insert 0 linear' 'load 0 bbtt' 'load 0 rstar' 'query 10 bbtt' 'query 10 rstar' \
            'nearest 10 bbtt' 'nearest 10 rstar' 'nearest 100 bbtt' 'nearest 100 rstar' 'pairs 0 bbtt' 'pairs 0 rstar'; do
  set -- $line
  case $1 in query | nearest) per=1000 ;; *) per=$count ;; esac
  valgrind --tool=callgrind --cache-sim=yes --branch-sim=yes --I1=65536,4,64 --D1=32768,8,64 --LL=524288,8,64 \
    --toggle-collect='*measured*' --callgrind-out-file=/dev/null "$program" "$1" "$2" "$3" "$data" "$count" 2>"$out" >/dev/null
  awk -v what="$1 $2" -v peer="$3" -v per=$per '/ Collected / {
    sub(/ 0$/, "", what)
    printf "| %s | %s | %.0f | %.1f | %.1f | %.1f |\n", what, peer, $4/per, ($8+$9)/per, ($11+$12)/per, ($14+$16)/per }' "$out"
done
