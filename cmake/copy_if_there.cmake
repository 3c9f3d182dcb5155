# cmake -D FROM=FILE -D TO=FOLDER -P: copies a file that may be missing, if it differs.
if(EXISTS ${FROM})
  file(COPY ${FROM} DESTINATION ${TO})
endif()
