#!/bin/sh
# Counts instructions, misses of caches as large as a Zen 3 core's (32 KB, 512 KB) and mispredicted branches, as callgrind
# sees them, per element inserted, loaded, paired or looked for, and per query: beside the peer in the line below.
#   bench/spatial_instructions/run.sh build/release/bin/bench_spatial_instructions [double3|float2 [uniform [100000 [OPERATIONS]]]]
set -eu
program=$1
type=${2:-double3}
data=${3:-uniform}
count=${4:-100000}
only=${5:-insert load query nearest pairs points within}
out=$(mktemp)
trap 'rm -f "$out"' EXIT
printf '| operation | container | instructions | beyond 32 KB | beyond 512 KB | mispredicted |\n|---|---|---|---|---|---|\n'
for line in 'insert 0 bbtt' 'insert 0 linear' 'load 0 bbtt' 'load 0 rstar' 'query 1 bbtt' 'query 1 rstar' \
            'query 10 bbtt' 'query 10 rstar' 'query 100 bbtt' 'query 100 rstar' 'nearest 1 bbtt' 'nearest 1 rstar' \
            'nearest 10 bbtt' 'nearest 10 rstar' 'nearest 100 bbtt' 'nearest 100 rstar' 'pairs 0 bbtt' 'pairs 0 rstar' \
            'points 1 bbtt' 'points 1 nanoflann' 'points 10 bbtt' 'points 10 nanoflann' 'points 100 bbtt' 'points 100 nanoflann' \
            'within 0 pcd' 'within 0 nanoflann'; do
  set -- $line
  case " $only " in *" $1 "*) ;; *) continue ;; esac
  case $1 in query | nearest | points) per=1000 ;; *) per=$count ;; esac
  valgrind --tool=callgrind --cache-sim=yes --branch-sim=yes --I1=65536,4,64 --D1=32768,8,64 --LL=524288,8,64 \
    --toggle-collect='*measured*' --callgrind-out-file=/dev/null "$program" "$1" "$2" "$3" "$data" "$count" "$type" 2>"$out" >/dev/null
  awk -v what="$1 $2" -v peer="$3" -v per=$per '/ Collected / {
    sub(/ 0$/, "", what)
    printf "| %s | %s | %.0f | %.1f | %.1f | %.1f |\n", what, peer, $4/per, ($8+$9)/per, ($11+$12)/per, ($14+$16)/per }' "$out"
done
