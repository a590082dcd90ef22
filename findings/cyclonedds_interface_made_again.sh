#!/usr/bin/env bash
# Eclipse Cyclone DDS 0.10.2, Debian 12: a participant does not survive that its network interface is deleted and made again.
#
# This is what happens when a USB network adapter is pulled and plugged in, or its driver is loaded again. The new interface has
# the same name and address. By default (multicast), the participant and the others lose each other as they should, and never
# find each other again, while a process that starts now finds the others. The only sign is a warning on stderr, "write to
# udp/239.255.0.1:7400 failed", which also comes while an interface is only down. Both directions fail: the kernel took the
# interface out of the multicast group, and Cyclone DDS does not join again; and its socket sends multicast by the interface
# that is gone. If the interface is only set down and up, all is well.
#
# Unicast still works, so the configuration can help. Give the machines in Discovery/Peers, with ParticipantIndex auto;
# multicast can stay on. Or set General/AllowMulticast to spdp: then announcements also go by unicast to each participant that
# was once found. Otherwise, restart the process. The intervals are short here, to save time.
#
# Debian packages: cyclonedds-dev 0.10.2-2, gcc, iproute2. It makes network namespaces, without root, where the kernel lets it.
set -euo pipefail
version=$(dpkg-query -W -f '${Version}' cyclonedds-dev 2>/dev/null || true)
[ "$version" = 0.10.2-2 ] || { echo "needs cyclonedds-dev 0.10.2-2"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >member.c <<'C'
#include <dds/dds.h>
#include <stdio.h>
#include <unistd.h>

// Prints, whenever it changes, how many other participants are there. It ends after 90 s.
int main(void) {
  alarm(90);
  const dds_entity_t participant = dds_create_participant(0, NULL, NULL);
  const dds_entity_t reader = dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, NULL, NULL);
  if (reader < 0) return 1;
  for (int last = -1;; usleep(100000)) {
    void *samples[8] = {0};
    dds_sample_info_t infos[8];
    const int count = dds_read_mask(reader, samples, infos, 8, 8,
                                    DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
    if (count > 0) dds_return_loan(reader, samples, count);
    if (count > 0 && count != last) printf("%d\n", (last = count) - 1), fflush(stdout);
  }
}
C
gcc member.c -o member -lddsc

# One case, in namespaces of its own: the robot has the interface robot0, the other one the interface other0.
cat >try.sh <<'BASH'
set -euo pipefail
what=$1 allow=$2 peers=$3
mkdir "$what"
trap 'kill -9 $(jobs -p) 2>/dev/null' EXIT
general="<General><AllowMulticast>$allow</AllowMulticast></General>"
discovery="<Discovery><SPDPInterval>500ms</SPDPInterval><LeaseDuration>2s</LeaseDuration>$peers</Discovery>"
export CYCLONEDDS_URI="<CycloneDDS><Domain id='any'>$general$discovery</Domain></CycloneDDS>"

make_interface() {
  ip link add link wire0 name robot0 address 02:00:00:00:00:01 type macvlan mode bridge
  ip addr add 10.9.0.1/24 dev robot0
  ip link set robot0 up
}
start() { # NAME COMMAND...: its output goes to NAME
  "${@:2}" >"$what/$1" 2>"$what/$1.warnings" &
}
each_sees() { # COUNT SECONDS ROBOT: whether the robot and the other one see so many within this time
  for _ in $(seq $(($2 * 10))); do
    [ "$(tail -qn 1 "$what/$3" "$what/other" | xargs)" = "$1 $1" ] && return
    sleep 0.1
  done
  return 1
}
in_group() { ip maddr show dev robot0 | grep -q 239.255.0.1 && echo "in the group" || echo "not in the group"; }
found() { each_sees 1 10 "$1" && echo found || echo "not found"; }
failures() { grep -c "write to udp/239.255.0.1:7400 failed" "$what/$1.warnings" || true; }
sends() { # ROBOT: whether its multicast, each 0.5 s, fails now
  local before
  before=$(failures "$1")
  sleep 2
  [ "$(failures "$1")" = "$before" ] && echo "multicast is sent" || echo "multicast fails"
}

unshare --net sleep 90 &
other=$!
while [ "$(readlink /proc/$other/ns/net)" = "$(readlink /proc/self/ns/net)" ]; do sleep 0.1; done
ip link set lo up
ip link add wire0 type veth peer name other0 netns $other
ip link set wire0 up
make_interface
there=(nsenter "--net=/proc/$other/ns/net")
"${there[@]}" sh -c 'ip link set lo up; ip addr add 10.9.0.2/24 dev other0; ip link set other0 up'
start other "${there[@]}" ./member
start robot ./member
robot=$!
echo "$what: at first: $(found robot), $(in_group), $(sends robot)"
if [ "$what" = "down and up" ]; then ip link set robot0 down; else ip link del robot0; fi
each_sees 0 10 robot && echo "$what: without the interface: lost"
sleep 12
if [ "$what" = "down and up" ]; then ip link set robot0 up; else make_interface; fi
echo "$what: with it again: $(found robot), $(in_group), $(sends robot)"
kill -9 $robot
each_sees 0 10 other || true
start restarted ./member
echo "$what: after a restart: $(found restarted), $(in_group), $(sends restarted)"
BASH
attempt() { timeout 80 unshare --user --map-root-user --net bash try.sh "$@" >"$1.seen" 2>>errors & }
attempt "down and up" true ""
attempt "made again" true ""
peers="<Peers><Peer Address='10.9.0.1'/><Peer Address='10.9.0.2'/></Peers>"
attempt "made again, with peers" true "<ParticipantIndex>auto</ParticipantIndex>$peers"
attempt "made again, with spdp" spdp ""
wait
cat "down and up.seen" "made again.seen" "made again, with peers.seen" "made again, with spdp.seen" >seen
diff - seen <<'SEEN' || { cat errors >&2; exit 1; }
down and up: at first: found, in the group, multicast is sent
down and up: without the interface: lost
down and up: with it again: found, in the group, multicast is sent
down and up: after a restart: found, in the group, multicast is sent
made again: at first: found, in the group, multicast is sent
made again: without the interface: lost
made again: with it again: not found, not in the group, multicast fails
made again: after a restart: found, in the group, multicast is sent
made again, with peers: at first: found, in the group, multicast is sent
made again, with peers: without the interface: lost
made again, with peers: with it again: found, not in the group, multicast fails
made again, with peers: after a restart: found, in the group, multicast is sent
made again, with spdp: at first: found, in the group, multicast is sent
made again, with spdp: without the interface: lost
made again, with spdp: with it again: found, not in the group, multicast fails
made again, with spdp: after a restart: found, in the group, multicast is sent
SEEN
echo "Cyclone DDS 0.10.2: as described"
