#!/usr/bin/env bash
# @mcap/core 2.2.2: without chunks, McapWriter writes a wrong offset into the index of an attachment that follows messages.
#
# With `useChunks: false`, it keeps messages in memory until an attachment or metadata comes. That gets the offset of the
# messages that are written together with it. The record itself is whole, and McapStreamReader reads it. But the index in the
# file is wrong for every reader: readAttachments() or readMetadata() of McapIndexedReader ends with an error, without those
# behind it.
#
# The offset of the next attachment is right, unless there are messages before it again. Around it: keep chunks, which are the
# default, or write all attachments and metadata before the first message.
#
# Debian packages: nodejs, npm. From npm: @mcap/core 2.2.2.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true}' >package.json
npm install --silent --no-audit --no-fund @mcap/core@2.2.2

cat >index.cjs <<'JS'
const { McapIndexedReader, McapStreamReader, McapWriter, TempBuffer } = require("@mcap/core");

async function write(useChunks, order) {
  const file = new TempBuffer();
  const writer = new McapWriter({ writable: file, useChunks });
  await writer.start({ profile: "", library: "" });
  const channelId = await writer.registerChannel({ topic: "pose", schemaId: 0, messageEncoding: "json", metadata: new Map() });
  for (const what of order.split(", ")) {
    if (what === "message")
      await writer.addMessage({ channelId, sequence: 1, logTime: 5n, publishTime: 5n, data: new Uint8Array([1, 2, 3]) });
    else if (what === "metadata") await writer.addMetadata({ name: what, metadata: new Map([["robot", "7"]]) });
    else
      await writer.addAttachment({ name: what, logTime: 5n, createTime: 5n, mediaType: "text/plain", data: new Uint8Array(4) });
  }
  await writer.end();

  // The offset of every record, by its length in the file: behind the magic, an opcode, eight bytes of length, and the content.
  const view = new DataView(file.get().buffer, file.get().byteOffset);
  const offsets = [];
  for (let at = 8; view.getUint8(at) !== 0x0f; at += 9 + Number(view.getBigUint64(at + 1, true))) {
    const kind = { 0x04: "Channel", 0x05: "Message", 0x09: "Attachment", 0x0c: "Metadata" }[view.getUint8(at)];
    if (kind) offsets.push([kind, at]);
  }
  const reader = await McapIndexedReader.Initialize({ readable: file });
  const indexed = [...reader.attachmentIndexes, ...reader.metadataIndexes].map(({ name, offset }) => {
    const found = offsets.find(([, at]) => at === Number(offset));
    return `${name} -> ${found ? found[0] : "nothing"}`;
  });
  const stream = new McapStreamReader();
  stream.append(file.get());
  let streamed = 0;
  for (let record; (record = stream.nextRecord()); ) if (["Attachment", "Metadata"].includes(record.type)) ++streamed;
  const count = async (records) => {
    let number = 0;
    try {
      for await (const _ of records) ++number;
    } catch {
      return `${number} and an error`;
    }
    return `${number}`;
  };
  console.log(`${useChunks ? "chunks" : "no chunks"}: ${order}`);
  console.log(`  index: ${indexed.join(", ")}`);
  console.log(`  McapStreamReader: ${streamed}`);
  const [attachments, metadata] = [await count(reader.readAttachments()), await count(reader.readMetadata())];
  console.log(`  McapIndexedReader: attachments ${attachments}, metadata ${metadata}`);
}
(async () => {
  await write(false, "message, map, plan");
  await write(false, "message, metadata");
  await write(false, "map, metadata, message");
  await write(true, "message, map, plan, metadata");
})();
JS
node index.cjs >seen
diff - seen <<'SEEN'
no chunks: message, map, plan
  index: map -> Channel, plan -> Attachment
  McapStreamReader: 2
  McapIndexedReader: attachments 0 and an error, metadata 0
no chunks: message, metadata
  index: metadata -> Channel
  McapStreamReader: 1
  McapIndexedReader: attachments 0, metadata 0 and an error
no chunks: map, metadata, message
  index: map -> Attachment, metadata -> Metadata
  McapStreamReader: 2
  McapIndexedReader: attachments 1, metadata 1
chunks: message, map, plan, metadata
  index: map -> Attachment, plan -> Attachment, metadata -> Metadata
  McapStreamReader: 3
  McapIndexedReader: attachments 2, metadata 1
SEEN
echo "@mcap/core 2.2.2: as described"
