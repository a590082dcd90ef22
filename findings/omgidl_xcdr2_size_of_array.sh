#!/usr/bin/env bash
# @foxglove/omgidl-serialization 1.0.3: it takes the size in front of an array of structs in XCDR2 for data.
#
# In XCDR2 an array or sequence whose elements are not primitive begins with its size in bytes, the DHEADER of DDS-XTypes.
# Eclipse Cyclone DDS 0.10.2, Debian 12, writes and reads it. MessageReader, which is documented to read XCDR2, does not know
# it. All behind it is shifted by four bytes: of an array of structs it returns wrong numbers, without an error. Of a sequence
# of structs, strings or enums it takes the size for the number of elements, which gives an error here.
#
# In XCDR1, and in a mutable struct, whose members all have a size, it reads the same sequence well. Around it: publish what is
# recorded in XCDR1, by the QoS policy DataRepresentation, with types that are final.
#
# Debian packages: cyclonedds-dev 0.10.2-2, cyclonedds-tools (idlc), gcc, nodejs, npm. From npm: @foxglove/omgidl-serialization
# 1.0.3, @foxglove/omgidl-parser 1.1.0, @foxglove/cdr 3.5.0.
set -euo pipefail
version=$(dpkg-query -W -f '${Version}' cyclonedds-dev 2>/dev/null || true)
[ "$version" = 0.10.2-2 ] || { echo "needs cyclonedds-dev 0.10.2-2"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
echo '{"private": true, "overrides": {"@foxglove/cdr": "3.5.0"}}' >package.json
npm install --silent --no-audit --no-fund @foxglove/omgidl-serialization@1.0.3 @foxglove/omgidl-parser@1.1.0

cat >area.idl <<'IDL'
module area {
  @final struct Point { double x; long y; };
  enum Kind { FREE, WALL };
  @final struct Numbers { long values[2]; long last; };
  @final struct Corners { Point points[2]; long last; };
  @final struct Route { sequence<Point> points; long last; };
  @final struct Names { sequence<string> texts; long last; };
  @final struct Kinds { sequence<Kind> values; long last; };
  @mutable struct MutableRoute { sequence<Point> points; long last; };
};
IDL
idlc area.idl

cat >write.c <<'C'
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <stdio.h>
#include <stdlib.h>
#include "area.h"

static dds_entity_t participant;
static FILE *own;

// Prints the bytes that a reader gets of a sample that a writer has sent.
static void show(const dds_topic_descriptor_t *type, const void *sample, dds_data_representation_id_t representation) {
  const char *name = type->m_typename + sizeof "area::" - 1;
  dds_qos_t *qos = dds_create_qos();
  dds_qset_data_representation(qos, 1, &representation);
  char topic_name[64];
  snprintf(topic_name, sizeof topic_name, "%s%d", name, (int)representation);
  const dds_entity_t topic = dds_create_topic(participant, type, topic_name, qos, NULL);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  struct ddsi_serdata *data = NULL;
  dds_sample_info_t info;
  if (dds_write(writer, sample) != 0 || dds_takecdr(reader, &data, 1, &info, DDS_ANY_STATE) != 1) exit(1);
  const size_t size = ddsi_serdata_size(data);
  unsigned char *bytes = malloc(size);
  ddsi_serdata_to_ser(data, 0, size, bytes);
  printf("%s XCDR%d ", name, representation == DDS_DATA_REPRESENTATION_XCDR1 ? 1 : 2);
  for (size_t i = 0; i < size; ++i) printf("%02x", bytes[i]);
  printf("\n");

  // And as Cyclone DDS reads it: here only the array of structs.
  if (type != &area_Corners_desc) return;
  area_Corners corners, *read = &corners;
  if (dds_write(writer, sample) != 0 || dds_take(reader, (void **)&read, &info, 1, 1) != 1) exit(1);
  fprintf(own, "Cyclone DDS, XCDR%d: ", representation == DDS_DATA_REPRESENTATION_XCDR1 ? 1 : 2);
  for (int i = 0; i < 2; ++i) fprintf(own, "(%g, %d) ", corners.points[i].x, (int)corners.points[i].y);
  fprintf(own, "last %d\n", (int)corners.last);
}

#define SEQUENCE(array) {sizeof array / sizeof *array, sizeof array / sizeof *array, array, false}

int main(void) {
  participant = dds_create_participant(0, NULL, NULL);
  own = fopen("own", "w");
  if (participant < 0 || !own) return 1;
  area_Point points[] = {{1.5, 1}, {2.5, 2}};
  char *names[] = {"a", "b"};
  area_Kind kinds[] = {area_FREE, area_WALL};
  const area_Numbers numbers = {{1, 2}, 7};
  const area_Corners corners = {{{1.5, 1}, {2.5, 2}}, 7};
  const area_Route route = {SEQUENCE(points), 7};
  const area_Names some_names = {SEQUENCE(names), 7};
  const area_Kinds some_kinds = {SEQUENCE(kinds), 7};
  const area_MutableRoute mutable_route = {SEQUENCE(points), 7};
  for (int i = 0; i < 2; ++i) {
    const dds_data_representation_id_t form = i == 0 ? DDS_DATA_REPRESENTATION_XCDR1 : DDS_DATA_REPRESENTATION_XCDR2;
    show(&area_Numbers_desc, &numbers, form);
    show(&area_Corners_desc, &corners, form);
    show(&area_Route_desc, &route, form);
    show(&area_Names_desc, &some_names, form);
    show(&area_Kinds_desc, &some_kinds, form);
  }
  show(&area_MutableRoute_desc, &mutable_route, DDS_DATA_REPRESENTATION_XCDR2);
}
C
gcc write.c area.c -o write -lddsc

cat >read.cjs <<'JS'
const { readFileSync } = require("node:fs");
const { parseIDL } = require("@foxglove/omgidl-parser");
const { MessageReader } = require("@foxglove/omgidl-serialization");
const definitions = parseIDL(readFileSync("area.idl", "utf8"));
const plain = (_, value) => (ArrayBuffer.isView(value) ? Array.from(value) : value);
for (const line of readFileSync("bytes", "utf8").trim().split("\n")) {
  const [name, form, bytes] = line.split(" ");
  let read;
  try {
    read = JSON.stringify(new MessageReader(`area::${name}`, definitions).readMessage(Buffer.from(bytes, "hex")), plain);
  } catch {
    read = "an error";
  }
  console.log(`${name}, ${form}: ${read.replaceAll('"', "")}`);
}
JS
interface="<Interfaces><NetworkInterface name='lo'/></Interfaces><AllowMulticast>false</AllowMulticast>"
CYCLONEDDS_URI="<CycloneDDS><Domain id='any'><General>$interface</General></Domain></CycloneDDS>" timeout 30 ./write >bytes
{
  cat own
  node read.cjs
} >seen
diff - seen <<'SEEN'
Cyclone DDS, XCDR1: (1.5, 1) (2.5, 2) last 7
Cyclone DDS, XCDR2: (1.5, 1) (2.5, 2) last 7
Numbers, XCDR1: {values:[1,2],last:7}
Corners, XCDR1: {points:[{x:1.5,y:1},{x:2.5,y:2}],last:7}
Route, XCDR1: {points:[{x:1.5,y:1},{x:2.5,y:2}],last:7}
Names, XCDR1: {texts:[a,b],last:7}
Kinds, XCDR1: {values:[0,1],last:7}
Numbers, XCDR2: {values:[1,2],last:7}
Corners, XCDR2: {points:[{x:1.2e-322,y:1073217536},{x:5e-324,y:1074003968}],last:2}
Route, XCDR2: an error
Names, XCDR2: an error
Kinds, XCDR2: an error
MutableRoute, XCDR2: {points:[{x:1.5,y:1},{x:2.5,y:2}],last:7}
SEEN
echo "@foxglove/omgidl-serialization 1.0.3: as described"
