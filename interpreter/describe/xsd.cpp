#include "describe/xsd.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/diagnostics.h"
#include "describe/node_reference.h"

namespace lockstep::host {
namespace {

// The beginning of every schema. XSD cannot keep a node from being the first element, but it can
// keep the elements of 'root' out of trees: an abstract element is never valid.
constexpr std::string_view kPrologue = R"xsd(<?xml version="1.0" encoding="UTF-8"?>
<!-- The tree language of lockstep. Made by `lockstep schema`; do not edit. -->
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" elementFormDefault="unqualified">

  <xs:simpleType name="substituted">
    <xs:annotation><xs:documentation>Contains ${…}: an argument of the tree, known when it is loaded.</xs:documentation></xs:annotation>
    <xs:restriction base="xs:string"><xs:pattern value="(.|\s)*$\{(.|\s)*\}(.|\s)*"/></xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="key">
    <xs:annotation><xs:documentation>{key}: an entry of the blackboard.</xs:documentation></xs:annotation>
    <xs:restriction base="xs:string"><xs:pattern value="\{[A-Za-z_][A-Za-z0-9_]*\}"/></xs:restriction>
  </xs:simpleType>
)xsd";

constexpr std::string_view kPrologueEnd = R"xsd(  <xs:simpleType name="boolean">
    <xs:union memberTypes="xs:boolean substituted"/>
  </xs:simpleType>
  <xs:simpleType name="word">
    <xs:annotation><xs:documentation>Not empty.</xs:documentation></xs:annotation>
    <xs:restriction base="xs:string"><xs:minLength value="1"/></xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="plainName">
    <xs:restriction base="xs:string"><xs:pattern value="[^/]+"/></xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="nodeName">
    <xs:annotation><xs:documentation>Not empty, without '/'.</xs:documentation></xs:annotation>
    <xs:union memberTypes="plainName substituted"/>
  </xs:simpleType>
  <xs:simpleType name="identifier">
    <xs:restriction base="xs:string"><xs:pattern value="[A-Za-z_][A-Za-z0-9_]*"/></xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="languageVersion">
    <xs:restriction base="xs:string"><xs:enumeration value="1"/></xs:restriction>
  </xs:simpleType>

  <xs:group name="nothing">
    <xs:annotation><xs:documentation>No elements, but whitespace and comments.</xs:documentation></xs:annotation>
    <xs:sequence><xs:element ref="_nothing" minOccurs="0"/></xs:sequence>
  </xs:group>
  <xs:element name="_nothing" abstract="true"/>

  <xs:attributeGroup name="common">
    <xs:attribute name="name" type="nodeName">
      <xs:annotation><xs:documentation>What the node is called in messages, views and recordings; its id when absent. Without '/'.</xs:documentation></xs:annotation>
    </xs:attribute>
    <xs:attribute name="_description" type="xs:string">
      <xs:annotation><xs:documentation>A remark for readers of the file.</xs:documentation></xs:annotation>
    </xs:attribute>
  </xs:attributeGroup>

  <xs:element name="root">
    <xs:complexType>
      <xs:choice minOccurs="0" maxOccurs="unbounded">
        <xs:element name="plugin">
          <xs:annotation><xs:documentation>A plugin that the trees of this file need, by its name.</xs:documentation></xs:annotation>
          <xs:complexType>
            <xs:group ref="nothing"/>
            <xs:attribute name="name" type="nodeName" use="required"/>
            <xs:attribute name="isolate" type="boolean">
              <xs:annotation><xs:documentation>true: the plugin runs in a separate process, so that it cannot bring down the run.</xs:documentation></xs:annotation>
            </xs:attribute>
            <xs:attribute name="program" type="word">
              <xs:annotation><xs:documentation>The plugin is a program: the name of its file, which is searched where plugins are.</xs:documentation></xs:annotation>
            </xs:attribute>
            <xs:attribute name="hold">
              <xs:annotation><xs:documentation>What happens to a leaf of the program while a synchronized node withholds its ticks: its process is stopped, it gets a message, or nothing.</xs:documentation></xs:annotation>
              <xs:simpleType>
                <xs:union memberTypes="substituted">
                  <xs:simpleType>
                    <xs:restriction base="xs:string">
                      <xs:enumeration value="signal"/>
                      <xs:enumeration value="message"/>
                      <xs:enumeration value="none"/>
                    </xs:restriction>
                  </xs:simpleType>
                </xs:union>
              </xs:simpleType>
            </xs:attribute>
          </xs:complexType>
        </xs:element>
        <xs:element name="arg">
          <xs:annotation><xs:documentation>A load-time argument: --arg name=value gives it, ${name} uses it.</xs:documentation></xs:annotation>
          <xs:complexType>
            <xs:group ref="nothing"/>
            <xs:attribute name="name" use="required">
              <xs:simpleType><xs:union memberTypes="identifier substituted"/></xs:simpleType>
            </xs:attribute>
            <xs:attribute name="default" type="xs:string"/>
            <xs:attribute name="doc" type="xs:string"/>
          </xs:complexType>
        </xs:element>
        <xs:element name="include">
          <xs:annotation><xs:documentation>Another file whose trees are used here; its path is relative to this file. With as="truck" its trees are truck.ID.</xs:documentation></xs:annotation>
          <xs:complexType>
            <xs:group ref="nothing"/>
            <xs:attribute name="path" type="word" use="required"/>
            <xs:attribute name="as">
              <xs:simpleType><xs:union memberTypes="identifier substituted"/></xs:simpleType>
            </xs:attribute>
          </xs:complexType>
        </xs:element>
        <xs:element name="property">
          <xs:annotation><xs:documentation>A property that each run of the main tree must satisfy, as text: never arm.failure. `lockstep run` checks it.</xs:documentation></xs:annotation>
          <xs:complexType>
            <xs:simpleContent>
              <xs:extension base="xs:string">
                <xs:attribute name="name" use="required">
                  <xs:simpleType><xs:union memberTypes="identifier substituted"/></xs:simpleType>
                </xs:attribute>
                <xs:attribute name="_description" type="xs:string"/>
              </xs:extension>
            </xs:simpleContent>
          </xs:complexType>
        </xs:element>
        <xs:element name="scenario">
          <xs:annotation><xs:documentation>The expected results when the leaves of the tree do this: `lockstep test` plays it. schema/scenarios.xsd defines the elements.</xs:documentation></xs:annotation>
          <xs:complexType mixed="true">
            <xs:sequence><xs:any processContents="skip" minOccurs="0" maxOccurs="unbounded"/></xs:sequence>
            <xs:anyAttribute processContents="skip"/>
          </xs:complexType>
        </xs:element>
        <xs:element name="TreeNodesModel">
          <xs:annotation><xs:documentation>What editors know of the nodes. lockstep reads it for 'run --mock' only.</xs:documentation></xs:annotation>
          <xs:complexType mixed="true">
            <xs:sequence><xs:any processContents="skip" minOccurs="0" maxOccurs="unbounded"/></xs:sequence>
            <xs:anyAttribute processContents="skip"/>
          </xs:complexType>
        </xs:element>
        <xs:element name="BehaviorTree">
          <xs:annotation><xs:documentation>One tree: exactly one node, with all that is in it.</xs:documentation></xs:annotation>
          <xs:complexType>
            <xs:sequence><xs:any namespace="##local" processContents="lax"/></xs:sequence>
            <xs:attribute name="ID" type="nodeName" use="required"/>
            <xs:attribute name="_description" type="xs:string"/>
          </xs:complexType>
        </xs:element>
      </xs:choice>
      <xs:attribute name="lockstep" use="required">
        <xs:annotation><xs:documentation>The version of the language.</xs:documentation></xs:annotation>
        <xs:simpleType><xs:union memberTypes="languageVersion substituted"/></xs:simpleType>
      </xs:attribute>
      <xs:attribute name="main_tree_to_execute" type="word">
        <xs:annotation><xs:documentation>The ID of the tree to run.</xs:documentation></xs:annotation>
      </xs:attribute>
    </xs:complexType>
  </xs:element>
  <xs:element name="BehaviorTree" abstract="true"/>
  <xs:element name="plugin" abstract="true"/>
  <xs:element name="arg" abstract="true"/>
  <xs:element name="include" abstract="true"/>
  <xs:element name="property" abstract="true"/>
  <xs:element name="scenario" abstract="true"/>
  <xs:element name="TreeNodesModel" abstract="true"/>
)xsd";

std::string annotation(std::string_view doc) {
  if (doc.empty()) return {};
  return fmt::format("<xs:annotation><xs:documentation>{}</xs:documentation></xs:annotation>",
                     xsd_escaped(printable(doc)));
}

// Those that the schema language does not have.
std::string value_types() {
  std::string text;
  for (const ValueType type : all_value_types()) {
    const SchemaType& it = schema_type(type);
    if (it.base.empty()) continue;
    text += fmt::format("  <xs:simpleType name=\"{}\">\n", it.name);
    if (!it.doc.empty()) text += fmt::format("    {}\n", annotation(it.doc));
    text += fmt::format("    <xs:restriction base=\"{}\"", it.base);
    text += it.pattern.empty()
                ? "/>\n"
                : fmt::format("><xs:pattern value=\"{}\"/></xs:restriction>\n", it.pattern);
    text += "  </xs:simpleType>\n";
  }
  return text;
}

std::string children(const Arity& arity) {
  if (arity.max == 0) return "      <xs:group ref=\"nothing\"/>\n";
  const std::string most = arity.max == Arity{}.max ? "unbounded" : fmt::format("{}", arity.max);
  return fmt::format(
      "      <xs:sequence><xs:any namespace=\"##local\" processContents=\"lax\" minOccurs=\"{}\" "
      "maxOccurs=\"{}\"/></xs:sequence>\n",
      arity.min, most);
}

std::string doc_of(const Parameter& parameter) {
  std::string doc(parameter.doc);
  if (!parameter.unit.empty()) doc += fmt::format(" Unit: {}.", parameter.unit);
  if (parameter.default_text) doc += fmt::format(" Default: '{}'.", *parameter.default_text);
  return doc;
}

std::string attribute(const Parameter& parameter) {
  const bool required = parameter.required && !parameter.default_text;
  return fmt::format(
      "      <xs:attribute name=\"{}\"{}>\n        {}\n        {}\n      </xs:attribute>\n",
      parameter.name, required ? " use=\"required\"" : "", annotation(doc_of(parameter)),
      xsd_type(parameter));
}

std::string script_attribute(const CommonAttribute& it) {
  return fmt::format(
      "    <xs:attribute name=\"{}\" type=\"word\">\n      {}\n    </xs:attribute>\n", it.name,
      annotation(it.doc));
}

std::string script_group() {
  std::string text = "\n  <xs:attributeGroup name=\"scripts\">\n";
  for (const CommonAttribute& it : script_attributes()) text += script_attribute(it);
  return text + "  </xs:attributeGroup>\n";
}

bool has_parameter(std::span<const Parameter> parameters, std::string_view name) {
  return std::ranges::find(parameters, name, &Parameter::name) != parameters.end();
}

// The scripts around the ticks of a node. A parameter of such a name comes first.
std::string scripts_of(std::span<const Parameter> parameters) {
  const auto is_taken = [&](const CommonAttribute& it) {
    return has_parameter(parameters, it.name);
  };
  if (std::ranges::none_of(script_attributes(), is_taken)) {
    return "      <xs:attributeGroup ref=\"scripts\"/>\n";
  }
  std::string text;
  for (const CommonAttribute& it : script_attributes()) {
    if (!is_taken(it)) text += script_attribute(it);
  }
  return text;
}

std::string element(std::string_view name, std::string_view doc, std::string_view content,
                    std::span<const Parameter> parameters = {}) {
  return fmt::format(
             "\n  <xs:element name=\"{}\">\n    {}\n    <xs:complexType>\n{}      "
             "<xs:attributeGroup ref=\"common\"/>\n",
             name, annotation(doc), content) +
         scripts_of(parameters);
}

constexpr std::string_view kElementEnd = "    </xs:complexType>\n  </xs:element>\n";
constexpr std::string_view kAnyAttribute =
    "      <xs:anyAttribute namespace=\"##local\" processContents=\"lax\"/>\n";

constexpr std::string_view kAnyId = R"(<xs:attribute name="ID" type="word" use="required"/>)";

// SubTree's other attributes are a remapping, those of an explicit form belong to the node that its
// ID names: of both, the schema knows no more than the ID.
std::string open_element(std::string_view name, std::string_view doc, const Arity& arity,
                         std::string_view more, std::string_view id = kAnyId) {
  return element(name, doc, children(arity)) + fmt::format("      {}\n", id) + std::string(more) +
         std::string(kAnyAttribute) + std::string(kElementEnd);
}

// The ID of an explicit form when no others exist than the nodes of its category.
std::string known_ids(NodeTypes types, NodeCategory category) {
  std::string ids;
  for (const NodeType* type : types) {
    if (type->category == category) ids += fmt::format("<xs:enumeration value=\"{}\"/>", type->id);
  }
  if (ids.empty()) ids = "<xs:length value=\"0\"/>";  // none at all
  return fmt::format(
      "<xs:attribute name=\"ID\" use=\"required\"><xs:simpleType><xs:union "
      "memberTypes=\"substituted\">"
      "<xs:simpleType><xs:restriction base=\"xs:string\">{}</xs:restriction></xs:simpleType>"
      "</xs:union></xs:simpleType></xs:attribute>",
      ids);
}

std::string explicit_forms(NodeTypes types, UnknownNodes unknown) {
  struct Form {
    std::string_view tag, doc;
    NodeCategory category;
    Arity arity;
  };
  constexpr Form kForms[] = {
      {"Action", "The action that ID names.", NodeCategory::Action, {0, 0}},
      {"Condition", "The condition that ID names.", NodeCategory::Condition, {0, 0}},
      {"Control", "The control node that ID names.", NodeCategory::Control, {1}},
      {"Decorator", "The decorator that ID names.", NodeCategory::Decorator, {1, 1}}};
  std::string text;
  for (const Form& form : kForms) {
    const std::string id =
        unknown == UnknownNodes::Refused ? known_ids(types, form.category) : std::string(kAnyId);
    text += open_element(form.tag, form.doc, form.arity, "", id);
  }
  return text;
}

std::string node(const NodeType& type) {
  if (type.category == NodeCategory::SubTree) {
    return open_element(type.id, type.doc, {0, 0},
                        "      <xs:attribute name=\"_autoremap\" type=\"boolean\"/>\n");
  }
  std::string text = element(type.id, type.doc, children(type.arity), type.parameters);
  for (const Parameter& parameter : type.parameters) text += attribute(parameter);
  if (has_action_attributes(type)) {
    for (const CommonAttribute& it : action_attributes()) {
      if (!has_parameter(type.parameters, it.name)) text += script_attribute(it);
    }
  }
  if (!type.more_parameters.empty()) text += kAnyAttribute;
  return text + std::string(kElementEnd);
}

// A group is declared in 'root' and cannot be in a tree.
std::string group(const NodeType& type) {
  std::string text =
      fmt::format("        <xs:element name=\"{}\">\n    {}\n    <xs:complexType>\n", type.id,
                  annotation(type.doc)) +
      children({0, 0}) +
      "      <xs:attribute name=\"name\" use=\"required\">\n"
      "        <xs:simpleType><xs:union memberTypes=\"identifier substituted\"/></xs:simpleType>\n"
      "      </xs:attribute>\n"
      "      <xs:attribute name=\"_description\" type=\"xs:string\"/>\n";
  for (const Parameter& parameter : type.parameters) text += attribute(parameter);
  return text + std::string(kElementEnd);
}

void add_group(const NodeType& type, std::string& text) {
  constexpr std::string_view kEndOfRoot = "      </xs:choice>\n";
  text.insert(text.find(kEndOfRoot), group(type));
  text += fmt::format("  <xs:element name=\"{}\" abstract=\"true\"/>\n", type.id);
}

// A strict wildcard takes only elements that the schema declares.
void refuse_unknown(std::string& text) {
  constexpr std::string_view kElements = "<xs:any namespace=\"##local\" processContents=\"";
  constexpr std::string_view kLax = "lax";
  for (auto at = text.find(kElements); at != std::string::npos; at = text.find(kElements, at + 1)) {
    text.replace(at + kElements.size(), kLax.size(), "strict");
  }
}

}  // namespace

std::string make_xsd(NodeTypes types, UnknownNodes unknown) {
  std::string text(kPrologue);
  text += value_types();
  text += kPrologueEnd;
  text += script_group();
  for (const NodeType* type : types) {
    if (type->category == NodeCategory::Group) add_group(*type, text);
  }
  text += explicit_forms(types, unknown);
  for (const NodeType* type : types) {
    if (type->category != NodeCategory::Group) text += node(*type);
  }
  text += "\n</xs:schema>\n";
  if (unknown == UnknownNodes::Refused) refuse_unknown(text);
  return text;
}

}  // namespace lockstep::host
