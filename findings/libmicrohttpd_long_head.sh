#!/usr/bin/env bash
# libmicrohttpd 0.9.75: it answers a request with a long head itself, and the head of that answer comes twice.
#
# MHD_OPTION_CONNECTION_MEMORY_LIMIT is 32 KiB by default. From half of it on, a head (here: one Cookie) is too large: the
# library sends 431 with a page of its own, and never calls the handler. Between one half and the whole limit, the status line
# and the headers of this answer are sent twice. Content-Length, 143, is the length of the page, so a client takes the second
# head for the body. Above the limit, the head comes once. No callback sees these requests: an API that promises JSON sends
# HTML here. A larger limit moves both borders.
#
# Debian packages: libmicrohttpd-dev 0.9.75-6, gcc, python3.
set -euo pipefail
version=$(dpkg-query -W -f '${Version}' libmicrohttpd-dev 2>/dev/null || true)
[ "$version" = 0.9.75-6 ] || { echo "needs libmicrohttpd-dev 0.9.75-6"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat >server.c <<'C'
#include <microhttpd.h>
#include <stdio.h>

static int calls;

static enum MHD_Result answer(void *cls, struct MHD_Connection *connection, const char *url, const char *method,
                              const char *version, const char *data, size_t *size, void **state) {
  static char json[] = "{}";
  (void)cls, (void)url, (void)method, (void)version, (void)data, (void)size, (void)state;
  ++calls;
  struct MHD_Response *response = MHD_create_response_from_buffer(2, json, MHD_RESPMEM_PERSISTENT);
  const enum MHD_Result result = MHD_queue_response(connection, 200, response);
  MHD_destroy_response(response);
  return result;
}

int main(void) {
  struct MHD_Daemon *server = MHD_start_daemon(MHD_USE_INTERNAL_POLLING_THREAD, 0, NULL, NULL, answer, NULL, MHD_OPTION_END);
  printf("%d\n", MHD_get_daemon_info(server, MHD_DAEMON_INFO_BIND_PORT)->port);
  fflush(stdout);
  getchar();
  printf("%d\n", calls);
  MHD_stop_daemon(server);
  return 0;
}
C
gcc server.c -o server -lmicrohttpd

cat >client.py <<'PYTHON'
import socket
import subprocess

server = subprocess.Popen(["./server"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
port = int(server.stdout.readline())
for size in (1_000, 15_000, 20_000, 30_000, 40_000):
    with socket.create_connection(("127.0.0.1", port)) as connection:
        connection.sendall(b"GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\nCookie: " + b"a" * size + b"\r\n\r\n")
        answer = b"".join(iter(lambda: connection.recv(65536), b""))
    kind = "JSON" if answer.endswith(b"{}") else "HTML"
    print(f"head of {size} bytes: {answer.split()[1].decode()}, {kind}, status lines: {answer.count(b'HTTP/1.1 ')}")
print("calls of the handler:", server.communicate("\n")[0].strip())
PYTHON
python3 client.py >seen
diff - seen <<'SEEN'
head of 1000 bytes: 200, JSON, status lines: 1
head of 15000 bytes: 200, JSON, status lines: 1
head of 20000 bytes: 431, HTML, status lines: 2
head of 30000 bytes: 431, HTML, status lines: 2
head of 40000 bytes: 431, HTML, status lines: 1
calls of the handler: 2
SEEN
echo "libmicrohttpd 0.9.75: as described"
