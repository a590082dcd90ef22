#!/usr/bin/env bash
# @mcap/core 2.2.2: McapIndexedReader silently skips the messages that no chunk index leads to.
#
# MCAP allows messages outside of chunks, and chunks without a chunk index: McapWriter writes such files with `useChunks: false`
# and with `useChunkIndex: false`. The indexed reader opens them, since they have a summary, and its `statistics` tell how many
# messages there are, but readMessages() ends without any. Only chunks without message indexes are an error. McapStreamReader
# reads all of them. So count what readMessages() gives for a whole file, and when `statistics.messageCount` is larger, read the
# file with McapStreamReader.
#
# Debian packages: nodejs, npm. From npm: @mcap/core 2.2.2.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund @mcap/core@2.2.2

cat >read.cjs <<'JS'
const { McapIndexedReader, McapStreamReader, McapWriter, TempBuffer } = require("@mcap/core");

async function read(options) {
  const file = new TempBuffer();
  const writer = new McapWriter({ writable: file, ...options });
  await writer.start({ profile: "", library: "" });
  const channelId = await writer.registerChannel({ topic: "pose", schemaId: 0, messageEncoding: "json", metadata: new Map() });
  for (let sequence = 1; sequence <= 3; ++sequence) {
    const time = BigInt(sequence);
    await writer.addMessage({ channelId, sequence, logTime: time, publishTime: time, data: new Uint8Array([sequence]) });
  }
  await writer.end();

  const stream = new McapStreamReader();
  stream.append(file.get());
  let streamed = 0;
  for (let record; (record = stream.nextRecord()); ) if (record.type === "Message") ++streamed;

  const indexed = await McapIndexedReader.Initialize({ readable: file });
  let found = 0, end = "no error";
  try {
    for await (const _ of indexed.readMessages()) ++found;
  } catch {
    end = "an error";
  }
  const { messageCount } = indexed.statistics;
  const counts = `statistics ${messageCount}, McapStreamReader ${streamed}, McapIndexedReader ${found}`;
  console.log(`${JSON.stringify(options)}: ${counts} and ${end}`);
}
(async () => {
  await read({});
  await read({ useChunks: false });
  await read({ useChunkIndex: false });
  await read({ useMessageIndex: false });
})();
JS
node read.cjs >seen
diff - seen <<'SEEN'
{}: statistics 3, McapStreamReader 3, McapIndexedReader 3 and no error
{"useChunks":false}: statistics 3, McapStreamReader 3, McapIndexedReader 0 and no error
{"useChunkIndex":false}: statistics 3, McapStreamReader 3, McapIndexedReader 0 and no error
{"useMessageIndex":false}: statistics 3, McapStreamReader 3, McapIndexedReader 0 and an error
SEEN
echo "@mcap/core 2.2.2: as described"
