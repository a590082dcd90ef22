// A simulated service robot that fetches and carries things in a small flat.
#include "driving.hpp"
#include "handling.hpp"
#include "upkeep.hpp"

LOCKSTEP_PLUGIN(
    "fetch", "1.0", "A simulated service robot that fetches and carries things in a small flat",
    lockstep::run_context<fetch::World>(),
    lockstep::leaf<fetch::At>("At", "Whether the robot stands at a place."),
    lockstep::leaf<fetch::DoorOpen>("DoorOpen", "Whether the door to a room is open."),
    lockstep::leaf<fetch::OpenDoor>("OpenDoor",
                                    "Opens the door to a room. Failure when the robot does not "
                                    "stand at that door, or when the handle slips."),
    lockstep::leaf<fetch::DriveTo>(
        "DriveTo",
        "Drives to a place: dock, sofa, kitchen_door, office_door, "
        "kitchen, office, counter, table, desk or shelf. Failure at a closed door, or "
        "with an empty battery; a meter takes 1% of it."),
    lockstep::leaf<fetch::Holding>("Holding", "Whether the gripper holds an object."),
    lockstep::leaf<fetch::ObjectSeen>("ObjectSeen",
                                      "Whether the robot has seen where an object lies."),
    lockstep::leaf<fetch::LookFor>("LookFor",
                                   "Looks around for an object: mug, book or bottle. Failure when "
                                   "it is not in the room that the robot is in."),
    lockstep::leaf<fetch::Grasp>("Grasp",
                                 "Grasps an object. Failure when the robot does not stand where it "
                                 "lies or holds another one, or when the gripper misses it."),
    lockstep::leaf<fetch::PutDown>("Place",
                                   "Puts what the gripper holds down where the robot stands. "
                                   "Failure when it holds nothing or is between two places."),
    lockstep::leaf<fetch::MoveArm>("MoveArm", "Moves the arm into a pose."),
    lockstep::leaf<fetch::BatteryAbove>("BatteryAbove",
                                        "Whether the battery is fuller than a level."),
    lockstep::leaf<fetch::Charge>("Charge",
                                  "Charges the battery up to a level. Failure when the robot does "
                                  "not stand at the dock."),
    lockstep::leaf<fetch::Say>("Say", "Says a text; it goes to the log."));
