"""The unit of the package under a real systemd: killed, hung, stopped, and after a power failure.

service_test.py PACKAGES WORK, as root. systemd is the first process of namespaces of its own, in a Debian that debootstrap
makes and that has the package. A power failure is the end of all of its processes at once, without a word to them."""
import glob
import os
import re
import shutil
import signal
import subprocess
import sys
import time

from debian import copy_base, make_base

PACKAGES, WORK = sys.argv[1:3]
BASE, ROOT = os.path.abspath(WORK) + "/base", os.path.abspath(WORK) + "/service"
UNIT, STATE = "lockstep@patrol", "/var/lib/lockstep/patrol"
PATH = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "SYSTEMD_PAGER": "", "LC_ALL": "C"}
BOOT = r"""
set -eu
mount --make-rprivate /
mount --bind "$1" "$1"
cd "$1"
mount -t proc proc proc
mount -t sysfs -o ro sysfs sys
mount -t cgroup2 cgroup2 sys/fs/cgroup
for folder in run tmp; do mount -t tmpfs -o mode=755 tmpfs $folder; done
mount -t tmpfs -o mode=755,dev tmpfs dev
for device in null zero full random urandom tty; do touch dev/$device; mount --bind /dev/$device dev/$device; done
mkdir dev/shm
ln -s /proc/self/fd dev/fd
mkdir -p .old
pivot_root . .old
umount -l /.old
exec env -i container=lockstep PATH=/usr/sbin:/usr/bin:/sbin:/bin /lib/systemd/systemd --show-status=no
"""


def say(what):
    print("service:", what, file=sys.stderr, flush=True)


def until(what, question, seconds=30):
    end = time.monotonic() + seconds
    while not (answer := question()):
        assert time.monotonic() < end, f"{what}: not within {seconds} s\n{System.running.journal()[-3000:]}"
        time.sleep(0.05)
    return answer


class System:
    """A machine that runs."""
    running = None

    def __init__(self):
        os.makedirs(GROUP, exist_ok=True)
        self.outer = subprocess.Popen(
            ["unshare", "--pid", "--mount", "--ipc", "--uts", "--cgroup", "--fork", "--kill-child", "sh", "-c", BOOT, "boot", ROOT],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            preexec_fn=lambda: open(GROUP + "/cgroup.procs", "w").write("0"))
        System.running = self
        self.first = until("the first process", self._first)
        until("systemd", lambda: self.call("systemctl", "is-system-running").stdout.strip() in ("running", "degraded"))

    def _first(self):
        with open(f"/proc/{self.outer.pid}/task/{self.outer.pid}/children", encoding="ascii") as children:
            return children.read().strip()

    def call(self, *words):
        return subprocess.run(["nsenter", "-t", self.first, "-a", *words], env=PATH, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)

    def must(self, *words):
        done = self.call(*words)
        assert done.returncode == 0, f"{words}: {done.returncode}\n{done.stdout}{self.journal()[-3000:]}"
        return done.stdout

    def show(self, name):
        return self.must("systemctl", "show", "--property", name, "--value", UNIT).strip()

    def journal(self):
        return self.call("journalctl", "--no-pager", "-o", "cat", "-u", UNIT).stdout

    def signal(self, name):
        """To the main process."""
        self.must("systemctl", "kill", "--kill-whom=main", "--signal=SIG" + name, UNIT)

    def resumed(self):
        return self.journal().count("       resumed after ")

    def process(self):
        return int(self.show("MainPID"))

    def end_power(self):
        os.kill(int(self.first), signal.SIGKILL)
        self.outer.wait()
        until("the end of all processes", remove_group)


def cgroup2():
    with open("/proc/mounts", encoding="utf-8") as mounts:
        return next(line.split()[1] for line in mounts if line.split()[2] == "cgroup2")


def remove_group():
    try:
        for folder, _, _ in os.walk(GROUP, topdown=False):
            os.rmdir(folder)
    except OSError:
        return False  # a process is still ending
    return True


def ticks(text):
    return [int(tick) for tick in re.findall(r"tick (\d+) .*walk: success", text)]


GROUP = cgroup2() + "/lockstep-service-test"
if os.geteuid() != 0 or not shutil.which("debootstrap"):
    sys.exit("service_test: needs root and debootstrap")
os.makedirs(WORK, exist_ok=True)
make_base(BASE)
copy_base(BASE, ROOT)
packages = glob.glob(PACKAGES + "/lockstep_*.deb")
assert packages, f"no lockstep_*.deb in {PACKAGES}: ./dev package"
for package in packages:
    shutil.copy(package, ROOT + "/root")
say("install the package")
for words in (["apt-get", "update", "-q"],
              ["sh", "-c", "DEBIAN_FRONTEND=noninteractive apt-get install -y -q systemd systemd-sysv dbus /root/lockstep_*.deb"]):
    done = subprocess.run(["chroot", ROOT, *words], env=PATH, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0, done.stdout
unit = f"{ROOT}/etc/systemd/system/lockstep@.service"
shutil.copy(ROOT + "/usr/share/doc/lockstep/examples/lockstep@.service", unit)
os.makedirs(ROOT + "/etc/lockstep")
shutil.copy(ROOT + "/usr/share/lockstep/trees/patrol.xml", ROOT + "/etc/lockstep/patrol.xml")
with open(ROOT + "/etc/lockstep/patrol.env", "w", encoding="utf-8") as settings:
    settings.write('LOCKSTEP_OPTIONS="--arg rounds=60 --arg cost=1"\n')
with open("/proc/self/status", encoding="utf-8") as status:
    rights = int(re.search(r"CapEff:\s*(\w+)", status.read())[1], 16)
if not rights >> 24 & 1:  # CAP_SYS_RESOURCE
    say("without --realtime: systemd cannot raise the limits of a process here")
    with open(unit, encoding="utf-8") as text:
        start = re.search(r"ExecStart=(?:.*\\\n)*.*\n", text.read())[0]
    os.makedirs(unit + ".d")
    with open(unit + ".d/here.conf", "w", encoding="utf-8") as here:
        here.write("[Service]\nExecStart=\n" + start.replace(" --realtime", ""))

system = System()
try:
    must = system.must
    must("systemctl", "enable", "--now", UNIT)
    say("killed three times, it continues each time")
    for times in range(1, 4):
        until("a leaf", lambda: ticks(system.journal().split("resumed after")[-1]))
        process = system.process()
        system.signal("KILL")
        until("another process", lambda: system.process() not in (0, process))
        until("it continues", lambda: system.resumed() == times)
    done = ticks(system.journal())
    assert done == sorted(set(done)), done
    assert system.show("NRestarts") == "3"

    say("hung, it is ended by the watchdog, and continues")
    system.signal("STOP")
    until("the watchdog", lambda: system.resumed() == 4)
    assert "SIGABRT" in system.journal()

    say("as a user of its own, with a folder of its own")
    status = must("cat", f"/proc/{system.process()}/status")
    user = re.search(r"Uid:\s*(\d+)", status)[1]
    assert int(user) > 60000 and re.search(r"CapEff:\s*0+\n", status), status
    assert must("stat", "-c", "%u %a", STATE + "/run.checkpoint").strip() == f"{user} 640"

    say("the power fails, and it continues after the start of the machine")
    before = ticks(system.journal())[-1]
    system.end_power()
    system = System()
    must = system.must
    until("it continues", lambda: system.resumed() == 5)
    after = until("a leaf", lambda: ticks(system.journal().split("resumed after")[-1]))
    assert before < after[0] <= before + 200, (before, after)

    say("stopped, it has ended in order, and begins anew")
    must("systemctl", "stop", UNIT)
    assert system.show("ActiveState") == "inactive", must("systemctl", "status", UNIT)
    assert "ended" in must("lockstep", "checkpoint", STATE + "/run.checkpoint")
    must("systemctl", "start", UNIT)
    until("a new run", lambda: 0 < ticks(system.journal())[-1] < before)
    assert system.resumed() == 5

    say("the mission ends, and is not started again")
    must("systemctl", "stop", UNIT)
    with open(ROOT + "/etc/lockstep/patrol.env", "w", encoding="utf-8") as settings:
        settings.write('LOCKSTEP_OPTIONS="--arg rounds=2"\n')
    must("systemctl", "start", UNIT)
    until("the end", lambda: system.show("ActiveState") == "inactive")
    assert system.show("Result") == "success" and system.show("NRestarts") == "0"

    must("systemctl", "reset-failed")  # it has started often in a minute
    say("killed, and another tree: it does not run, and reports the difference")
    with open(ROOT + "/etc/lockstep/patrol.env", "w", encoding="utf-8") as settings:
        settings.write('LOCKSTEP_OPTIONS="--arg rounds=60"\n')
    must("systemctl", "start", UNIT)
    until("a leaf", lambda: "walk: success" in system.journal().split("run of Patrol starts")[-1])
    with open(ROOT + "/etc/lockstep/patrol.env", "w", encoding="utf-8") as settings:
        settings.write('LOCKSTEP_OPTIONS="--arg rounds=61"\n')
    system.signal("KILL")
    until("the end", lambda: system.show("ActiveState") == "failed")
    assert system.show("ExecMainStatus") == "3" and "is of another run" in system.journal()
    print("service: all steps succeed")
finally:
    system.end_power()
