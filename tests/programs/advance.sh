#!/bin/bash
# Advance of the plugin motion; awk computes, since bash has no fractions.
echo '{"lockstep":1,"leaves":[{"id":"Advance","progress":true,"ports":[{"name":"step","type":"double","default":0.01}]}]}'
declare -A progress step
while IFS= read -r line; do
  [[ $line =~ ^\{\"do\":\"([a-z]+)\",\"leaf\":([0-9]+) ]]
  leaf=${BASH_REMATCH[2]}
  case ${BASH_REMATCH[1]} in
    create | halt) echo "{\"leaf\":$leaf,\"done\":true}" ;;
    start) [[ $line =~ \"step\":([0-9.e-]+) ]] && step[$leaf]=${BASH_REMATCH[1]} progress[$leaf]=0 ;;
    tick)
      read -r progress[$leaf] status < <(awk -v p="${progress[$leaf]}" -v s="${step[$leaf]}" 'BEGIN {
        p += s; if (p > 1) p = 1; printf "%.17g %s\n", p, (p >= 1 - 1e-9 ? "success" : "running") }')
      echo "{\"leaf\":$leaf,\"status\":\"$status\",\"progress\":${progress[$leaf]}}"
      ;;
  esac
done
