# IN, a text in base64, as `const char* const culet::embedded::viewer_engine` in OUT. Pieces stay under the
# length that compilers must accept for one literal.
file(READ ${IN} content)
string(LENGTH "${content}" size)
set(text "// Made by the build.\nnamespace culet::embedded {\nextern const char* const viewer_engine;\nconst char* const viewer_engine =")
set(at 0)
while(at LESS size)
  string(SUBSTRING "${content}" ${at} 12000 piece)
  string(APPEND text "\n\"${piece}\"")
  math(EXPR at "${at} + 12000")
endwhile()
file(WRITE ${OUT} "${text};\n}  // namespace culet::embedded\n")
