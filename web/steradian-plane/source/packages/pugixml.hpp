// The part of pugixml that the reader of SVG files asks for, on RapidXML: Debian's pugixml is a library of the machine, RapidXML is headers.
#pragma once

#include <cstddef>
#include <rapidxml/rapidxml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace pugi {

enum node_type { node_null, node_element, node_pcdata, node_cdata, node_other };
enum encoding { encoding_auto };
inline constexpr unsigned parse_default = 0;

struct xml_parse_result {
  std::ptrdiff_t offset = 0;
  const char* problem = nullptr;
  explicit operator bool() const { return problem == nullptr; }
  const char* description() const { return problem; }
};

class xml_attribute {
 public:
  explicit xml_attribute(const rapidxml::xml_attribute<>* a = nullptr) : a_(a) {}
  explicit operator bool() const { return a_ != nullptr; }
  const char* name() const { return a_ == nullptr ? "" : a_->name(); }
  const char* value() const { return a_ == nullptr ? "" : a_->value(); }
  const char* as_string(const char* otherwise = "") const { return a_ == nullptr ? otherwise : a_->value(); }
  const rapidxml::xml_attribute<>* raw() const { return a_; }

 private:
  const rapidxml::xml_attribute<>* a_;
};

class xml_node {
 public:
  explicit xml_node(const rapidxml::xml_node<>* n = nullptr, const char* text = nullptr) : n_(n), text_(text) {}
  explicit operator bool() const { return n_ != nullptr; }
  bool operator==(const xml_node& other) const { return n_ == other.n_; }
  bool operator!=(const xml_node& other) const { return n_ != other.n_; }
  const void* internal_object() const { return n_; }

  const char* name() const { return n_ == nullptr ? "" : n_->name(); }
  const char* value() const { return n_ == nullptr ? "" : n_->value(); }
  xml_node parent() const { return n_ == nullptr ? xml_node() : xml_node(n_->parent(), text_); }
  // Into the text, which the parser has worked on in place.
  std::ptrdiff_t offset_debug() const {
    if (n_ == nullptr || text_ == nullptr) return 0;
    return (n_->type() == rapidxml::node_element ? n_->name() : n_->value()) - text_;
  }
  node_type type() const {
    if (n_ == nullptr) return node_null;
    switch (n_->type()) {
      case rapidxml::node_element: return node_element;
      case rapidxml::node_data: return node_pcdata;
      case rapidxml::node_cdata: return node_cdata;
      default: return node_other;
    }
  }
  xml_attribute attribute(const char* key) const { return xml_attribute(n_ == nullptr ? nullptr : n_->first_attribute(key)); }
  std::vector<xml_attribute> attributes() const {
    std::vector<xml_attribute> all;
    for (auto* a = n_ == nullptr ? nullptr : n_->first_attribute(); a != nullptr; a = a->next_attribute()) all.emplace_back(a);
    return all;
  }
  std::vector<xml_node> children(const char* key = nullptr) const {
    std::vector<xml_node> all;
    for (auto* c = n_ == nullptr ? nullptr : n_->first_node(key); c != nullptr; c = c->next_sibling(key)) all.emplace_back(c, text_);
    return all;
  }

 private:
  const rapidxml::xml_node<>* n_;
  const char* text_;
};

class xml_document {
 public:
  xml_parse_result load_buffer(const char* data, std::size_t size, unsigned, encoding) {
    if (const std::ptrdiff_t deep = too_deep({data, size}); deep >= 0) return {deep, "elements are nested too deeply"};
    text_.assign(data, data + size);
    text_.push_back('\0');
    try {
      tree_.parse<rapidxml::parse_validate_closing_tags>(text_.data());
    } catch (const rapidxml::parse_error& e) {
      return {e.where<char>() - text_.data(), e.what()};
    }
    if (tree_.first_node() == nullptr) return {0, "there is no element"};
    return {};
  }
  xml_node document_element() const { return xml_node(tree_.first_node(), text_.data()); }

 private:
  // RapidXML calls itself for every level; the stack of a page's WebAssembly is small. Where the file goes deeper than 1000 levels, or -1.
  static std::ptrdiff_t too_deep(std::string_view text) {
    int depth = 0;
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at + 1)) {
      const std::size_t end = text.find('>', at);
      if (end == std::string_view::npos) break;
      const char next = text[at + 1];
      if (next == '/')
        --depth;
      else if (next != '!' && next != '?' && text[end - 1] != '/' && ++depth > 1000)
        return static_cast<std::ptrdiff_t>(at);
    }
    return -1;
  }

  std::vector<char> text_;
  rapidxml::xml_document<> tree_;
};

}  // namespace pugi
