# Ninja starts two more jobs than there are cores, whatever memory there is. No more files are compiled at once than there
# are cores, and than memory holds of the largest (1.5 GB).
cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
cmake_host_system_information(RESULT megabytes QUERY TOTAL_PHYSICAL_MEMORY)
math(EXPR CULET_JOBS "${megabytes} / 1500")
if(CULET_JOBS GREATER cores)
  set(CULET_JOBS ${cores})
elseif(CULET_JOBS LESS 1)
  set(CULET_JOBS 1)
endif()
set_property(GLOBAL PROPERTY JOB_POOLS compile=${CULET_JOBS})
set(CMAKE_JOB_POOL_COMPILE compile)
