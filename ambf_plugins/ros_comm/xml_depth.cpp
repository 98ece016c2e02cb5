#include "ros_comm/xml_depth.h"

#include <dlfcn.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

#include "base/bounds.h"

namespace {

using Parser = bool (*)(XmlRpc::XmlRpcValue* self, const std::string& xml, int* offset);

Parser library_parser() {
  static const auto parser = reinterpret_cast<Parser>(
      dlsym(RTLD_NEXT, "_ZN6XmlRpc11XmlRpcValue7fromXmlERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEEPi"));
  return parser;
}

thread_local int depth = 0;

}  // namespace

// The dynamic linker takes the program's definition of a function before a library's, also for calls within the
// library: each level of a value passes here.
bool XmlRpc::XmlRpcValue::fromXml(const std::string& xml, int* offset) {
  const Parser parser = library_parser();
  if (parser == nullptr || depth >= ambf::base::kMaxXmlDepth) return false;
  ++depth;
  const bool good = parser(this, xml, offset);
  --depth;
  return good;
}

namespace ambf::ros_comm {

bool bound_xml_depth() {
  if (library_parser() == nullptr) return false;
  std::string nested;
  for (int i = 0; i <= base::kMaxXmlDepth; ++i) nested += "<value><array><data>";
  for (int i = 0; i <= base::kMaxXmlDepth; ++i) nested += "</data></array></value>";
  int offset = 0;
  XmlRpc::XmlRpcValue outer(nested, &offset);
  // An array whose innermost level is missing: the library alone would have built them all.
  int levels = 0;
  for (XmlRpc::XmlRpcValue* value = &outer; value->getType() == XmlRpc::XmlRpcValue::TypeArray; ++levels) {
    if (value->size() == 0) return levels < base::kMaxXmlDepth + 1;
    value = &(*value)[0];
  }
  return levels <= base::kMaxXmlDepth;
}

}  // namespace ambf::ros_comm
