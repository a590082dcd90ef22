/* A program without lockstep as a member of a team: it is 'right' of the team 'table' in
 * docs/team.md, and waits for 'left' at the barriers 0.25, 0.5 and 0.75.
 *   idlc team.idl && cc team_member.c team.c -lddsc -o team_member && ./team_member [domain] */
#include <dds/dds.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "team.h"

typedef lockstep_msgs_msg_dds__TeamMember_ Word;

int main(int count, char** arguments) {
  const dds_domainid_t domain = count > 1 ? (dds_domainid_t)atoi(arguments[1]) : 0;
  const dds_entity_t participant = dds_create_participant(domain, NULL, NULL);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_MSECS(10));
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  const dds_entity_t topic = dds_create_topic(participant, &lockstep_msgs_msg_dds__TeamMember__desc,
                                              "rt/lockstep/team", qos, NULL);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  const dds_entity_t writer = dds_create_writer(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  if (reader < 0 || writer < 0) return 1;

  Word own = {.team = "table",
              .member = "right",
              .run = (uint64_t)dds_time(),
              .is_in = true,
              .period = 0.01};
  int done = 0;     /* of 100 steps */
  double left = -1; /* the progress of the other one in this round; -1: it is not in it */
  dds_time_t heard = 0;
  while (own.passed == 0) {
    void* samples[1] = {NULL};
    dds_sample_info_t info;
    while (dds_take(reader, samples, &info, 1, 1) > 0) {
      const Word* word = samples[0];
      if (info.valid_data && strcmp(word->team, "table") == 0 &&
          strcmp(word->member, "left") == 0) {
        own.declaration = word->declaration; /* both must declare the team in one way */
        if (own.round == 0) own.round = word->round == 0 ? 1 : word->round;
        const bool is_in = word->is_in && word->round == own.round;
        left = word->passed >= own.round ? 1 : is_in ? word->progress : -1;
        heard = dds_time();
      }
      dds_return_loan(reader, samples, 1);
    }
    /* who has completed the round may be gone */
    const bool is_heard = left >= 1 || (own.round != 0 && dds_time() - heard < DDS_MSECS(50));
    const double barrier = done / 25 * 0.25;
    if (is_heard && (barrier == 0 || left >= barrier)) ++done; /* the motion */
    own.progress = done / 100.0;
    if (done == 100) { /* the round is over */
      own.passed = own.round++;
      own.is_in = false;
      own.progress = 0;
    }
    ++own.number;
    dds_write(writer, &own);
    dds_sleepfor(DDS_MSECS(10));
  }
  puts("success");
  dds_sleepfor(DDS_MSECS(500)); /* so that the last word arrives */
  dds_delete(participant);
  return 0;
}
