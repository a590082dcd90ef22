"""Asks a run what Groot2 asks, and prints each answer as a line of JSON.

client.py PORT REQUEST…     a request is a letter, or a letter, ':' and its second part;
                            end asks for statuses until the root does not run;
                            listen:KEY asks to unlock that breakpoint until an event comes
client.py PORT --raw HEX…   each is the parts of a message as hexadecimal digits, with ',' between
"""

import json
import os
import struct
import sys

import msgpack
import zmq

PROTOCOL = 2


def triples(data):
    return [list(struct.unpack_from("<HB", data, at)) for at in range(0, len(data), 3)]


def transitions(data):
    return [
        [int.from_bytes(data[at : at + 6], "little"), *struct.unpack_from("<HB", data, at + 6)]
        for at in range(0, len(data), 9)
    ]


DECODED = {"S": triples, "B": msgpack.unpackb, "t": transitions}


def answer(socket, parts):
    socket.send_multipart(parts)
    reply = socket.recv_multipart()
    if reply[0] == b"error":
        return {"error": reply[1].decode(), "parts": len(reply)}
    said = {"parts": len(reply), "repeats": reply[0][:6] == parts[0][:6], "tree": reply[0][6:].hex()}
    kind = chr(reply[0][1])
    if len(reply) > 1:
        said["value"] = DECODED.get(kind, bytes.decode)(reply[1])
        said["hex"] = reply[1].hex()
    return said


def header(kind):
    return struct.pack("<BB", PROTOCOL, ord(kind)) + os.urandom(4)


def wait_for_end(socket):
    said = answer(socket, [header("S")])
    while said["value"][0][1] == 1:
        said = answer(socket, [header("S")])
    return said


def listen(context, socket, port, key):
    """A listener hears nothing until its wish to has arrived: of an early event it may not."""
    listener = context.socket(zmq.SUB)
    listener.setsockopt(zmq.LINGER, 0)
    listener.setsockopt(zmq.SUBSCRIBE, b"")
    listener.connect("tcp://127.0.0.1:%d" % (port + 1))
    while not listener.poll(100):
        answer(socket, [header("U"), key])
    head, uid = listener.recv_multipart()
    return {"events": [head.hex(), uid.decode()]}


def main():
    port = int(sys.argv[1])
    context = zmq.Context()
    socket = context.socket(zmq.REQ)
    socket.setsockopt(zmq.LINGER, 0)
    socket.setsockopt(zmq.RCVTIMEO, 20000)
    socket.connect("tcp://127.0.0.1:%d" % port)
    words = sys.argv[2:]
    is_raw = words[:1] == ["--raw"]
    for word in words[is_raw:]:
        kind, colon, value = word.partition(":")
        if is_raw:
            said = answer(socket, [bytes.fromhex(part) for part in word.split(",")])
        elif kind == "end":
            said = wait_for_end(socket)
        elif kind == "listen":
            said = listen(context, socket, port, value.encode())
        else:
            said = answer(socket, [header(kind)] + ([value.encode()] if colon else []))
        print(json.dumps(said), flush=True)


main()
