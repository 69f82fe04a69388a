# install and find_package(culet): see below
