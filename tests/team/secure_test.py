"""Robots in step over a network with the security of DDS: with keys that one authority has signed they are in step, a
robot without a key is not heard, and one whose key is not that of its permissions is told so.

The files are made as an authority for a team would make them: docs/security.md.

usage: secure_test.py LOCKSTEP TREE; exits with 77 where openssl or the security of Cyclone DDS is missing.
"""
import glob
import os
import shutil
import subprocess
import sys

import robots

LOCKSTEP, TREE = sys.argv[1:3]
PLUGINS = "/usr/lib/*/libddsc0debian/libdds_security_{}.so"
DOMAIN = str(1 + os.getpid() % 200)
TOPIC = "rt/lockstep/team"

GOVERNANCE = """<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <domain_access_rules>
    <domain_rule>
      <domains><id_range><min>0</min><max>230</max></id_range></domains>
      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
      <enable_join_access_control>true</enable_join_access_control>
      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
      <rtps_protection_kind>ENCRYPT</rtps_protection_kind>
      <topic_access_rules>
        <topic_rule>
          <topic_expression>*</topic_expression>
          <enable_discovery_protection>true</enable_discovery_protection>
          <enable_liveliness_protection>true</enable_liveliness_protection>
          <enable_read_access_control>true</enable_read_access_control>
          <enable_write_access_control>true</enable_write_access_control>
          <metadata_protection_kind>ENCRYPT</metadata_protection_kind>
          <data_protection_kind>ENCRYPT</data_protection_kind>
        </topic_rule>
      </topic_access_rules>
    </domain_rule>
  </domain_access_rules>
</dds>
"""
PERMISSIONS = """<?xml version="1.0" encoding="UTF-8"?>
<dds>
  <permissions>
    <grant name="{name}">
      <subject_name>CN={name}</subject_name>
      <validity><not_before>2020-01-01T00:00:00</not_before><not_after>2100-01-01T00:00:00</not_after></validity>
      <allow_rule>
        <domains><id_range><min>0</min><max>230</max></id_range></domains>
        <publish><topics><topic>{topic}</topic></topics></publish>
        <subscribe><topics><topic>{topic}</topic></topics></subscribe>
      </allow_rule>
      <default>DENY</default>
    </grant>
  </permissions>
</dds>
"""
SECURITY = """<CycloneDDS><Domain id="any"><Security>
  <Authentication>
    <Library path="{auth}" initFunction="init_authentication" finalizeFunction="finalize_authentication"/>
    <IdentityCA>file:{folder}/authority.pem</IdentityCA>
    <IdentityCertificate>file:{folder}/{name}.pem</IdentityCertificate>
    <PrivateKey>file:{folder}/{name}.key</PrivateKey>
  </Authentication>
  <Cryptographic>
    <Library path="{crypto}" initFunction="init_crypto" finalizeFunction="finalize_crypto"/>
  </Cryptographic>
  <AccessControl>
    <Library path="{ac}" initFunction="init_access_control" finalizeFunction="finalize_access_control"/>
    <PermissionsCA>file:{folder}/authority.pem</PermissionsCA>
    <Governance>file:{folder}/governance.p7s</Governance>
    <Permissions>file:{folder}/{permissions}.p7s</Permissions>
  </AccessControl>
</Security></Domain></CycloneDDS>
"""


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def openssl(folder, *arguments):
    subprocess.run(["openssl", *arguments], cwd=folder, check=True, capture_output=True)


def sign(folder, name):
    openssl(folder, "smime", "-sign", "-in", f"{name}.xml", "-text", "-out", f"{name}.p7s", "-signer", "authority.pem",
            "-inkey", "authority.key")


def make_files(folder):
    for name in ("authority", "left", "right"):
        openssl(folder, "ecparam", "-name", "prime256v1", "-genkey", "-noout", "-out", f"{name}.key")
    openssl(folder, "req", "-x509", "-new", "-key", "authority.key", "-out", "authority.pem", "-days", "30", "-subj", "/CN=authority")
    for name in ("left", "right"):
        openssl(folder, "req", "-new", "-key", f"{name}.key", "-out", f"{name}.csr", "-subj", f"/CN={name}")
        openssl(folder, "x509", "-req", "-in", f"{name}.csr", "-CA", "authority.pem", "-CAkey", "authority.key",
                "-CAcreateserial", "-out", f"{name}.pem", "-days", "30")
        write(f"{folder}/permissions_{name}.xml", PERMISSIONS.format(name=name, topic=TOPIC))
        sign(folder, f"permissions_{name}")
    write(f"{folder}/governance.xml", GOVERNANCE)
    sign(folder, "governance")


def security(folder, name, permissions):
    path = f"{folder}/{name}.{permissions}.xml"
    paths = {part: glob.glob(PLUGINS.format(part))[0] for part in ("auth", "crypto", "ac")}
    write(path, SECURITY.format(folder=folder, name=name, permissions=permissions, **paths))
    return {"CYCLONEDDS_URI": f"file://{path}"}


def robot(name, folder, environment):
    os.environ.pop("CYCLONEDDS_URI", None)
    os.environ.update(environment)
    return robots.Robot([LOCKSTEP, "run", TREE, "--arg", f"me={name}", "--team-domain", DOMAIN, "--team-peer", "127.0.0.1"],
                        f"{folder}/{name}.{len(robots.every)}.jsonl")


def test_robots_with_keys_are_in_step_and_hear_no_other(folder):
    make_files(folder)
    left = robot("left", folder, security(folder, "left", "permissions_left"))
    stranger = robot("right", folder, {})
    stranger.wait_for("left: failure: not heard yet")
    left.wait_for("right: failure: not heard yet")
    wrong = robot("right", folder, security(folder, "right", "permissions_left"))
    wrong.wait_for("the team cannot be reached: .*[Pp]ermissions")
    assert wrong.end() == 2, "one with the permissions of another robot runs"
    right = robot("right", folder, security(folder, "right", "permissions_right"))
    left.succeeds()
    right.succeeds()
    assert "left: started" not in stranger.text, "a robot without a key has heard one with a key"
    stranger.kill()


if shutil.which("openssl") is None or not glob.glob(PLUGINS.format("auth")):
    print("no openssl, or no security of Cyclone DDS", file=sys.stderr)
    sys.exit(77)
robots.run_tests(globals())
