// Values nested without end do not overflow the stack of roscpp's parser.
#include "ros_comm/xml_depth.h"

#include <gtest/gtest.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

namespace ambf::ros_comm {
namespace {

std::string nested(int levels) {
  std::string xml;
  for (int i = 0; i < levels; ++i) xml += "<value><array><data>";
  xml += "<value><i4>7</i4></value>";
  for (int i = 0; i < levels; ++i) xml += "</data></array></value>";
  return xml;
}

TEST(XmlDepth, TheProgramsParserStandsBeforeTheLibrarys) { EXPECT_TRUE(bound_xml_depth()); }

TEST(XmlDepth, OrdinaryValuesAreReadAsEver) {
  const std::string xml = nested(4);
  int offset = 0;
  XmlRpc::XmlRpcValue value(xml, &offset);
  ASSERT_TRUE(value.valid());
  EXPECT_EQ(static_cast<int>(value[0][0][0][0]), 7);
  EXPECT_EQ(offset, static_cast<int>(xml.size()));
}

TEST(XmlDepth, AHundredThousandLevelsEndAtTheBound) {
  const std::string xml = nested(100'000);
  int offset = 0;
  const XmlRpc::XmlRpcValue value(xml, &offset);  // a stack overflow without the bound
  EXPECT_LT(offset, static_cast<int>(xml.size()));
}

}  // namespace
}  // namespace ambf::ros_comm
