/* Lies as a member of a team: first 50,000 names that are in no team, then, until it is killed, the
 * name 'right' and a progress that is no number. liar DOMAIN */
#include <dds/dds.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "team.h"

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const dds_entity_t participant =
      dds_create_participant((dds_domainid_t)atoi(arguments[1]), NULL, NULL);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  const dds_entity_t topic = dds_create_topic(participant, &lockstep_msgs_msg_dds__TeamMember__desc,
                                              "rt/lockstep/team", qos, NULL);
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  if (writer < 0) return 1;
  dds_publication_matched_status_t matched = {0};
  while (matched.current_count == 0) {
    dds_get_publication_matched_status(writer, &matched);
    dds_sleepfor(DDS_MSECS(10));
  }
  char name[32];
  lockstep_msgs_msg_dds__TeamMember_ word = {
      .team = "table", .member = name, .run = 1, .progress = NAN};
  for (int i = 0; i < 50000; ++i) {
    snprintf(name, sizeof name, "ghost_%d", i);
    ++word.number;
    dds_write(writer, &word);
  }
  if (dds_wait_for_acks(writer, DDS_SECS(60)) != 0) return 1;
  word.member = "right";
  for (;;) {
    ++word.number;
    dds_write(writer, &word);
    dds_sleepfor(DDS_MSECS(10));
  }
}
