// The same as shapes.c, over lockstep/leaf.hpp.
#include <cstdio>
#include <lockstep/leaf.hpp>

namespace {

struct ShapePorts : lockstep::Ports {
  Fixed<std::string> kind{this, "kind", required, "which shape"};
};

// How to compute the area of a shape.
struct Form {
  std::string size;
  double factor;  // of the square of its size
};

struct BoxPorts : lockstep::Ports {
  Fixed<std::string> kind{this, "kind", required, "which shape", one_of("round;square")};
};

template <class PortsOfShape>
class Shape : public lockstep::Action<PortsOfShape> {
 public:
  using Status = lockstep::Status;
  static constexpr const char* more_ports = "size.*;out.*";
  static void describe(lockstep::Element& element) {
    const Form form = form_of(element["kind"]);
    element.output<double>("out.area", "its area");
    element.output<std::string>("out.text", "");
    element.input<lockstep::Number>(form.size, lockstep::Required(), "how large it is", "m",
                                    lockstep::Ports::between(0, 100));
    element.keep(form);
  }

  Status tick() override {
    const double size = size_.get();
    area_.set(form_.factor * size * size);
    char text[64];
    std::snprintf(text, sizeof text, "%s of %g", this->kind.get().c_str(), size);
    text_.set(text);
    return Status::Success;
  }

 private:
  static Form form_of(const std::string& kind) {
    if (kind == "round") return {"size.radius", 3};
    if (kind == "square") return {"size.side", 1};
    throw lockstep::Refusal("kind", "there is no such shape", "use round or square");
  }

  const Form& form_ = lockstep::kept<Form>(*this);
  lockstep::MorePort<double> area_{this, "out.area"};
  lockstep::MorePort<std::string> text_{this, "out.text"};
  lockstep::MorePort<lockstep::Number> size_{this, form_.size};
};

}  // namespace

LOCKSTEP_PLUGIN("shapes_sdk", "1", "for tests",
                lockstep::leaf<Shape<ShapePorts>>("Shape", "computes an area"),
                lockstep::leaf<Shape<BoxPorts>>("Box", "computes an area"));
