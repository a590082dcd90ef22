"""A program without lockstep as a member of a team: it is 'right' of the team 'table' in docs/team.md, as team_member.c is.
  idlc team.idl && cc -shared -fPIC team.c -o libteam.so -lddsc && python3 team_member.py ./libteam.so [domain]"""
import sys
import time
from ctypes import CDLL, POINTER, Structure, byref, c_bool, c_char_p, c_double, c_int64, c_size_t, c_uint, c_uint32, c_uint64, c_void_p
from ctypes.util import find_library

RELIABLE, TRANSIENT_LOCAL, KEEP_LAST = 1, 1, 0


class List(Structure):
    _fields_ = [("maximum", c_uint32), ("length", c_uint32), ("buffer", c_void_p), ("release", c_bool)]


class Word(Structure):  # all fields of team.idl: those of a shared pool stay 0 here
    _fields_ = [("team", c_char_p), ("member", c_char_p), ("run", c_uint64), ("number", c_uint64), ("declaration", c_uint64),
                ("round", c_uint32), ("passed", c_uint32), ("is_in", c_bool), ("progress", c_double), ("period", c_double),
                ("pool", c_uint64), ("term", c_uint32), ("decider", c_uint32), ("follows", c_uint64), ("has_left", c_bool),
                ("asks", List), ("answers", List)]


class Info(Structure):
    _fields_ = [("states", c_uint * 3), ("valid_data", c_bool), ("more", c_uint64 * 16)]


dds, types = CDLL(find_library("ddsc")), CDLL(sys.argv[1])
dds.dds_create_qos.restype = c_void_p
dds.dds_qset_reliability.argtypes = [c_void_p, c_uint, c_int64]
dds.dds_take.argtypes = [c_uint, POINTER(c_void_p), POINTER(Info), c_size_t, c_uint32]
participant, qos = dds.dds_create_participant(int((sys.argv[2:] or ["0"])[0]), None, None), c_void_p(dds.dds_create_qos())
dds.dds_qset_reliability(qos, RELIABLE, 10_000_000)  # ns
dds.dds_qset_durability(qos, TRANSIENT_LOCAL)
dds.dds_qset_history(qos, KEEP_LAST, 1)
description = byref(c_void_p.in_dll(types, "lockstep_msgs_msg_dds__TeamMember__desc"))
topic = dds.dds_create_topic(participant, description, b"rt/lockstep/team", qos, None)
reader, writer = (dds.dds_create_reader(participant, topic, qos, None), dds.dds_create_writer(participant, topic, qos, None))
if reader < 0 or writer < 0:
    sys.exit("DDS cannot be used")

own = Word(team=b"table", member=b"right", run=time.time_ns(), is_in=True, period=0.01)
done, left, heard = 0, -1, 0  # of 100 steps; the progress of the other one in this round, -1: it is not in it; when it was heard
while own.passed == 0:
    sample, info = c_void_p(None), Info()
    while dds.dds_take(reader, byref(sample), byref(info), 1, 1) > 0:
        word = Word.from_address(sample.value)
        if info.valid_data and (word.team, word.member) == (b"table", b"left"):
            own.declaration = word.declaration  # both must declare the team in one way
            own.round = own.round or word.round or 1
            is_in = word.is_in and word.round == own.round
            left, heard = 1 if word.passed >= own.round else word.progress if is_in else -1, time.monotonic()
        dds.dds_return_loan(reader, byref(sample), 1)
    barrier = done // 25 * 0.25
    is_heard = left >= 1 or time.monotonic() - heard < 0.05  # who has completed the round may be gone
    if is_heard and (barrier == 0 or left >= barrier):
        done += 1  # the motion
    own.progress = done / 100
    if done == 100:  # the round is over
        own.passed, own.round, own.is_in, own.progress = own.round, own.round + 1, False, 0
    own.number += 1
    dds.dds_write(writer, byref(own))
    time.sleep(0.01)
print("success")
time.sleep(0.5)  # so that the last word arrives
dds.dds_delete(participant)
