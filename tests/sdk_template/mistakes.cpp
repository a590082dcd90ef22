// One mistake of a plugin author per number: the compiler must refuse it, with the words that
// mistakes.cmake expects. MISTAKE=0 is right.
#include <lockstep/leaf.hpp>

enum class Grip { Soft, Firm };
enum class Unnamed { One };
LOCKSTEP_CHOICES(Grip, "soft;firm");
struct Path {};
struct NoName {};
LOCKSTEP_OBJECT_TYPE(Path, "nav.Path");

struct GoodPorts : lockstep::Ports {
  Input<double> step{this, "step", "0.1", "a step"};
#if MISTAKE == 1
  Input<double> again{this, "step", "0.1", "the same name"};
#elif MISTAKE == 2
  Input<double> other{this, "other", "fast", "not a number"};
#elif MISTAKE == 3
  Input<int> other{this, "other", "1", "not a type of port"};
#elif MISTAKE == 4
  Input<double> other{this, "my-port", "1", "not a name"};
#elif MISTAKE == 5
  Input<double> other{this, "name", "1", "every node has a name"};
#elif MISTAKE == 12
  Output<double> other{this, "other", "0", "a default for an output"};
#elif MISTAKE == 13
  Output<std::string> other{this, "other", "0", "a default for an output"};
#elif MISTAKE == 14
  Input<std::vector<std::int64_t> > other{this, "other", "1;0.5", "not a list of int"};
#elif MISTAKE == 15
  Output<lockstep::Number> other{this, "other", "neither an int nor a double"};
#elif MISTAKE == 16
  Input<double> other{this, "other", "21", "too much", "N", between(0, 20)};
#elif MISTAKE == 17
  Input<Grip> other{this, "other", "hard", "none of the words"};
#elif MISTAKE == 18
  Input<std::string> other{this, "other", "1", "no number", between(0, 20)};
#elif MISTAKE == 19
  Input<std::string> other{this, "other", "a", "blanks", one_of("a; b")};
#elif MISTAKE == 20
  Input<Unnamed> other{this, "other", "1", "an enum without names"};
#elif MISTAKE == 21
  Input<double> other{this, "other", required, "the wrong way round", between(20, 0)};
#elif MISTAKE == 22
  Input<double> other{this, "other", "1", "no text", one_of("1;2")};
#elif MISTAKE == 23
  Input<std::shared_ptr<const Path> > other{this, "other", "1;2", "an object has no default"};
#elif MISTAKE == 24
  Input<std::shared_ptr<const NoName> > other{this, "other", required, "an object without a name"};
#elif MISTAKE == 25
  Input<std::shared_ptr<Path> > other{this, "other", required, "an object that could change"};
#else
  Input<std::shared_ptr<const Path> > path{this, "path", required, "an object"};
  Input<Grip> grip{this, "grip", "firm", "an enum"};
  Input<double> force{this, "force", "0.1", "how much", "N", between(0, 0.1)};
  Output<double> speed{this, "speed", "no value", "m/s"};
  Output<std::vector<double> > points{this, "points", "", "m"};
  Output<std::string> text{this, "text", "true"};
  Output<std::vector<std::string> > texts{this, "texts", "true"};
#endif
};

class Good : public lockstep::Action<GoodPorts> {
 public:
  Status tick() override {
#if MISTAKE == 6
    step.set(1);
#endif
    return Status::Success;
  }
#if MISTAKE == 7
  double progress() const override {
    return random();
  }
#elif MISTAKE == 8
 private:
  void start() override {}
#elif MISTAKE == 9
  void stop() override {}
#endif
};

class Shape : public lockstep::Action<GoodPorts> {
 public:
  static constexpr const char* more_ports = "size.*";
#if MISTAKE == 27
  static void describe() {}
#elif MISTAKE == 28
  static void describe(lockstep::Element& element) {
    element.output<lockstep::Number>("size.x", "neither an int nor a double");
  }
#else
  static void describe(lockstep::Element& element) {
    element.input<double>("size.x", required, "how large", "m", at_least(0));
  }
#endif
  Status tick() override {
    return Status::Success;
  }
};

#if MISTAKE == 26
#define SHAPE_AGAIN lockstep::leaf<Shape>("Again", ""),
#else
#define SHAPE_AGAIN
#endif

#if MISTAKE == 10
#define ID "Other"
#elif MISTAKE == 11
#define ID "2nd"
#else
#define ID "Good"
#endif

LOCKSTEP_PLUGIN("good", "1", "", lockstep::leaf<Good>("Other", ""),
                SHAPE_AGAIN lockstep::leaf<Shape>("Shape", ""), lockstep::leaf<Good>(ID, ""));
