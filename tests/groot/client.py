"""Asks a run what Groot2 asks, and prints each answer as a line of JSON.

client.py PORT REQUEST…     a request is a letter, or a letter, ':' and its second part
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


def main():
    context = zmq.Context()
    socket = context.socket(zmq.REQ)
    socket.setsockopt(zmq.LINGER, 0)
    socket.setsockopt(zmq.RCVTIMEO, 20000)
    socket.connect("tcp://127.0.0.1:" + sys.argv[1])
    words = sys.argv[2:]
    if words[:1] == ["--raw"]:
        messages = [[bytes.fromhex(part) for part in word.split(",")] for word in words[1:]]
    else:
        messages = []
        for word in words:
            kind, colon, value = word.partition(":")
            header = struct.pack("<BB", PROTOCOL, ord(kind)) + os.urandom(4)
            messages.append([header] + ([value.encode()] if colon else []))
    for message in messages:
        print(json.dumps(answer(socket, message)), flush=True)


main()
