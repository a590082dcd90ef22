// The flat that the fetch robot serves, one per run: a hall, two rooms behind doors, three things
// lying about, and the robot with one gripper and a battery. Which doors are open, where the things
// lie and how full the battery is depend on the seed. Leaves change it; it does not move by itself.
#pragma once

#include <array>
#include <lockstep/leaf.hpp>
#include <string_view>
#include <vector>

namespace fetch {

struct Point {
  double x, y;  // m
};
double distance(Point a, Point b);

struct Place {
  std::string_view name;
  std::string_view room;
  Point point;
};

struct Door {
  std::string_view room;   // the room that it leads to, from the hall
  std::string_view place;  // where the robot stands to open it
  Point point;
  bool is_open = false;
};

struct Object {
  std::string_view name;
  const Place* place = nullptr;  // none: in the gripper
  bool is_known = false;         // the robot knows where it lies
};

struct Waypoint {
  Point point;
  std::string_view room;       // that the robot is in from here on
  const Door* door = nullptr;  // that must be open to come here
};

class World {
 public:
  explicit World(lockstep::Run& run);

  // By name. A name that does not exist is a mistake in the tree: they throw, and tell those that
  // do exist.
  static const Place& place(std::string_view name);
  Door& door(std::string_view room);
  Object& object(std::string_view name);

  // The way from where the robot is, through the doors in between.
  std::vector<Waypoint> route_to(const Place& goal) const;

  Point position;
  std::string_view room;
  const Place* at = nullptr;  // none: between two places
  Object* held = nullptr;
  double arm = 0;      // 0 stowed, 1 stretched out
  double battery = 1;  // 0 empty, 1 full

 private:
  const Door* door_of(std::string_view of_room) const;

  std::array<Door, 2> doors_;
  std::array<Object, 3> objects_;
};

}  // namespace fetch
