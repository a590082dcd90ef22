"""A small Debian in a folder, for tests of packages."""
import os
import subprocess


def make_base(folder):
    if os.path.exists(folder + "/etc/debian_version"):
        return
    subprocess.run(["debootstrap", "--variant=minbase", "bookworm", folder, "http://deb.debian.org/debian"], check=True,
                   stdout=subprocess.DEVNULL)


def copy_base(folder, to):
    subprocess.run(["rm", "-rf", to], check=True)
    subprocess.run(["cp", "-a", folder, to], check=True)
    subprocess.run(["cp", "/etc/resolv.conf", to + "/etc/resolv.conf"], check=True)
