// What attachments are beside whole images: slices, other formats, views.pathule targets
// extWe