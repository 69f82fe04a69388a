#include "page/html.h"

#include <gtest/gtest.h>

#include <cmath>

namespace culet {
namespace {

// RFC 4648, section 10.
TEST(Html, Base64OfThePublishedVectors) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Html, BytesOfBase64OfThePublishedVectors) {
    for (const char* text : {"", "f", "fo", "foo", "foob", "fooba", "foobar"})
        EXPECT_EQ(bytes_of_base64(base64(text)), text);
    std::string all;
    for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
    EXPECT_EQ(bytes_of_base64(base64(all)), all);
    for (const char* broken : {"Zg=", "Z===", "Zg==Zg==", "Zm9v Zm9", "Zm9-", "===="})
        EXPECT_EQ(bytes_of_base64(broken), std::nullopt) << broken;
}

TEST(Html, NumbersAreWrittenForReaders) {
    EXPECT_EQ(decimals(-0.001, 2), "0.00");
    EXPECT_EQ(decimals(-1.5, 1),
              "\xe2\x88\x92"
              "1.5");
    EXPECT_EQ(decimals(std::nullopt, 1), "\xe2\x80\x93");
    EXPECT_EQ(decimals(std::nan(""), 1), "\xe2\x80\x93");
    EXPECT_EQ(significant(0.00123456), "0.00123");
    EXPECT_EQ(significant(1234.5), "1234");
    EXPECT_EQ(significant(0.0), "0");
    EXPECT_EQ(significant(1e-13),
              "1.00e\xe2\x88\x92"
              "13");
}

TEST(Html, EscapesTextAndReplacesWhatIsNotUtf8) {
    EXPECT_EQ(escaped("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
    EXPECT_EQ(escaped("\xc3\xa9\xe2\x82\xac"), "\xc3\xa9\xe2\x82\xac");
    EXPECT_EQ(escaped("\xc3"), "\xef\xbf\xbd");
    EXPECT_EQ(escaped("\xed\xa0\x80"), "\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd");  // a surrogate
    EXPECT_EQ(escaped(std::string("\x1b[2J")), "\xef\xbf\xbd[2J");
}

}  // namespace
}  // namespace culet
